// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reading of whole ranges: short reads and interruptions are dealt with here.
#include "input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

namespace pcl_bv {

// O_NONBLOCK: a pipe without a writer must be refused, not waited for. Regular files ignore it.
InputFile::InputFile(const std::filesystem::path& path) : file_(path, O_RDONLY | O_NONBLOCK, 0, "") {
  struct stat status;
  if (::fstat(file_.get(), &status) != 0) throw IoError(system_reason(errno));
  if (S_ISDIR(status.st_mode)) throw IoError(system_reason(EISDIR));
  if (!S_ISREG(status.st_mode)) throw IoError("not a regular file");
  if (status.st_size == 0) throw IoError("empty file");
  size_ = static_cast<std::size_t>(status.st_size);
}

void InputFile::read(std::size_t offset, void* to, std::size_t bytes) const {
  char* at = static_cast<char*>(to);
  while (bytes > 0) {
    const ssize_t got = ::pread(file_.get(), at, bytes, static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw IoError(system_reason(errno));
    if (got == 0) throw IoError("truncated: the file became shorter while it was read");
    at += got;
    offset += static_cast<std::size_t>(got);
    bytes -= static_cast<std::size_t>(got);
  }
}

void InputFile::expect(std::size_t offset, std::size_t bytes) const {
  ::posix_fadvise(file_.get(), static_cast<off_t>(offset), static_cast<off_t>(bytes), POSIX_FADV_WILLNEED);
}

IoError not_enough_memory(const InputFile& file) {
  return IoError("not enough memory for its points, file of " + std::to_string(file.size()) + " bytes");
}

}  // namespace pcl_bv
