// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Uses POSIX calls without a buffer in this process, so that no written text is lost when the process is
// killed.

#include "line_file.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "pcl_bv/io/atomic_file.h"
#include "pcl_bv/io/posix_file.h"

namespace pcl_bv::detail {

LineFile::LineFile(const std::filesystem::path& file) : descriptor_(STDOUT_FILENO) {
  if (file == "-") return;
  create_parent_folders(file);
  constexpr int flags = O_WRONLY | O_CREAT | O_CLOEXEC;
  descriptor_ = ::open(file.c_str(), flags | O_EXCL, 0644);
  if (descriptor_ >= 0) {
    created_ = file;
  } else if (descriptor_ = ::open(file.c_str(), flags, 0644); descriptor_ < 0) {
    throw IoError(system_reason(errno));
  }
}

LineFile::~LineFile() {
  if (descriptor_ > STDOUT_FILENO) ::close(descriptor_);
  if (!created_.empty()) ::unlink(created_.c_str());
}

// Empties a regular file. For other files, such as pipes, ftruncate() fails with EINVAL, which is ignored.
void LineFile::begin() {
  if (std::exchange(begun_, true) || descriptor_ == STDOUT_FILENO) return;
  if (::ftruncate(descriptor_, 0) != 0 && errno != EINVAL) throw IoError(system_reason(errno));
  created_.clear();
}

void LineFile::write(std::string text, std::string_view tail) {
  begin();
  if (tail_ > 0 && ::lseek(descriptor_, -tail_, SEEK_CUR) < 0) throw IoError(system_reason(errno));
  tail_ = static_cast<off_t>(tail.size());
  text += tail;
  for (std::string_view rest = text; !rest.empty();) {
    const ssize_t written = ::write(descriptor_, rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) {
      pollfd writable{descriptor_, POLLOUT, 0};
      ::poll(&writable, 1, -1);
      continue;
    }
    if (written < 0 && errno == EPIPE) throw ClosedPipe(system_reason(errno));
    if (written < 0) throw IoError(system_reason(errno));
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
}

void LineFile::close() {
  if (descriptor_ <= STDOUT_FILENO) return;
  begin();
  if (::close(std::exchange(descriptor_, -1)) != 0) throw IoError(system_reason(errno));
}

}  // namespace pcl_bv::detail
