// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "line_file.h"

#include <unistd.h>

#include <cerrno>

namespace pcl_bv::detail {

LineFile::LineFile(const std::filesystem::path& file) {
  if (file == "-") return;
  file_.emplace(file);
}

void LineFile::write(std::string text, std::string_view tail) {
  text += tail;
  const int error = file_ ? file_->append(text, tail.size()) : write_whole(STDOUT_FILENO, text);
  if (error == EPIPE) throw ClosedPipe(system_reason(error));
  if (error != 0) throw IoError(system_reason(error));
}

void LineFile::close() {
  if (const int error = file_ ? file_->close() : 0) throw IoError(system_reason(error));
}

}  // namespace pcl_bv::detail
