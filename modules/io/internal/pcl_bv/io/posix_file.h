// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// POSIX files: an owned descriptor, and input by position.
#pragma once

#include <sys/stat.h>
#include <unistd.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>

#include "pcl_bv/io/io_error.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// The system's words for an errno value, starting in lower case: "permission denied".
std::string system_reason(int error);

inline constexpr char kChangedWhileRead[] = "the file was changed while it was read";

/// Owns an open descriptor.
class FileDescriptor {
 public:
  /// Opens as open(2) does, close-on-exec. Throws IoError: `context` and the system's reason.
  FileDescriptor(const std::filesystem::path& path, int flags, unsigned mode, const std::string& context);
  ~FileDescriptor() { close(); }
  FileDescriptor(FileDescriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&&) = delete;

  int get() const { return fd_; }

  /// Closes now; false, and errno says why, if what was written may be lost.
  bool close() { return fd_ < 0 || ::close(std::exchange(fd_, -1)) == 0; }

 private:
  int fd_;
};

/// A regular file open for reading: with pread, not mmap, since a file cut while it is read must give an
/// error, not SIGBUS.
class InputFile {
 public:
  /// Throws IoError if it cannot be opened, is a folder, is not regular or is empty.
  explicit InputFile(const std::filesystem::path& path);

  /// Bytes it had when it was opened; > 0.
  std::size_t size() const { return size_; }

  /// Fills `to` with `bytes` bytes from `offset` on. Throws IoError if they are not there (any more), and if
  /// the file has been changed since it was opened: what was read before and now would be of two clouds.
  void read(std::size_t offset, void* to, std::size_t bytes) const;

  /// Tells the system that these bytes will be read soon.
  void prefetch(std::size_t offset, std::size_t bytes) const;

  /// Throws IoError if size or times are not those of the opening.
  void require_unchanged() const;

 private:
  FileDescriptor file_;
  std::size_t size_ = 0;
  struct stat opened_ {};
};

}  // namespace pcl_bv
