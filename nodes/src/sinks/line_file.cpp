// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Plain POSIX: nothing stays in a buffer of ours when a process is killed.

#include "line_file.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace pcl_bv {

LineFile::LineFile(const std::filesystem::path& file)
    : descriptor_(STDOUT_FILENO), name_(file == "-" ? "standard output" : file.string()) {
  if (file == "-") return;
  descriptor_ = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor_ < 0) throw IoError(name_ + ": " + std::strerror(errno));
}

LineFile::~LineFile() {
  if (descriptor_ > STDOUT_FILENO) ::close(descriptor_);
}

void LineFile::write(std::string line) {
  line += '\n';
  for (std::string_view rest = line; !rest.empty();) {
    const ssize_t written = ::write(descriptor_, rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) {
      pollfd writable{descriptor_, POLLOUT, 0};
      ::poll(&writable, 1, -1);
      continue;
    }
    if (written < 0 && errno == EPIPE) throw ClosedPipe(name_ + ": " + std::strerror(errno));
    if (written < 0) throw IoError(name_ + ": " + std::strerror(errno));
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
}

void LineFile::close() {
  if (descriptor_ <= STDOUT_FILENO) return;
  if (::close(std::exchange(descriptor_, -1)) != 0) throw IoError(name_ + ": " + std::strerror(errno));
}

}  // namespace pcl_bv
