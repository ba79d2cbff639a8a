// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A text file that other programs may read while it grows.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "pcl_bv/io/growing_file.h"
#include "pcl_bv/nodes/frame_sink.h"

namespace pcl_bv::detail {

/// A text file, or standard output for "-". Each write() is one system call if the system takes the whole
/// text. The first call of write() or close() empties an existing file. Without such a call, an existing file
/// is unchanged, and a file that this object created is removed.
class LineFile {
 public:
  /// Throws IoError if the file cannot be opened, or if another program or output writes to it.
  explicit LineFile(const std::filesystem::path& file);

  /// Appends `text` and `tail`. If the previous call of write() had a tail, overwrites that tail. Throws
  /// IoError if the text cannot be written; a regular file then has its former content. If SIGPIPE is
  /// ignored, throws ClosedPipe for a pipe without a reader.
  void write(std::string text, std::string_view tail = {});

  /// Closes the file. Throws IoError if the system only now reports an error of writing.
  void close();

 private:
  std::optional<GrowingFile> file_;  // none for standard output
};

}  // namespace pcl_bv::detail
