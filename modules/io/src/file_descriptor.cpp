// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "file_descriptor.h"

#include <fcntl.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <system_error>

#include "pcl_bv/io/io_error.h"

namespace pcl_bv {

std::string system_reason(int error) {
  std::string reason = std::generic_category().message(error);
  if (!reason.empty()) reason[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(reason[0])));
  return reason;
}

FileDescriptor::FileDescriptor(const std::filesystem::path& path, int flags, unsigned mode,
                               const std::string& context)
    : fd_(::open(path.c_str(), flags | O_CLOEXEC, mode)) {
  if (fd_ < 0) throw IoError(context + system_reason(errno));
}

FileDescriptor::~FileDescriptor() {
  close();
}

int FileDescriptor::close() {
  if (fd_ < 0) return 0;
  const int error = ::close(fd_) == 0 ? 0 : errno;
  fd_ = -1;
  return error;
}

}  // namespace pcl_bv
