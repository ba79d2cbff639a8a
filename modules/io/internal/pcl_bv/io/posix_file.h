// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Classes for POSIX files. FileDescriptor owns a descriptor. InputFile reads bytes from any offset of a file.
#pragma once

#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Returns the system's message for an errno value. It starts in lower case, such as "permission denied".
std::string system_reason(int error);

/// Text of the IoError for a file that changed while it was read.
inline constexpr char kChangedWhileRead[] = "the file was changed while it was read";

/// Owns an open file descriptor and closes it at destruction.
class FileDescriptor {
 public:
  /// Opens the file as open(2) does, with O_CLOEXEC. Throws IoError with `context` and the system's reason.
  FileDescriptor(const std::filesystem::path& path, int flags, unsigned mode, const std::string& context);
  /// Takes an open descriptor.
  explicit FileDescriptor(int descriptor) : fd_(descriptor) {}
  ~FileDescriptor() { close(); }
  FileDescriptor(FileDescriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&&) = delete;

  /// Returns the descriptor's number, or -1 if it is closed.
  int get() const { return fd_; }

  /// Closes the descriptor now. Returns false and sets errno if written data may be lost.
  bool close() { return fd_ < 0 || ::close(std::exchange(fd_, -1)) == 0; }

 private:
  int fd_;
};

/// Device, inode, size and times of a file. They are equal only for the same file with the same content.
using FileIdentity = std::array<std::int64_t, 7>;

/// A regular file open for reading. InputFile uses pread instead of mmap, because a file that is cut while it
/// is read must cause an error, not SIGBUS.
class InputFile {
 public:
  /// Opens the file. Throws IoError if it cannot be opened, is a folder, is not a regular file or is empty.
  explicit InputFile(const std::filesystem::path& path);

  /// Returns the file's size in bytes at the time it was opened. The size is > 0.
  std::size_t size() const { return size_; }

  /// Reads `bytes` bytes from `offset` on into `to`. Throws IoError if the file is too short. Also throws
  /// IoError if the file has changed since it was opened, because bytes read before and after the change
  /// could belong to different clouds.
  void read(std::size_t offset, void* to, std::size_t bytes) const;

  /// Tells the system that `bytes` bytes from `offset` on will be read soon.
  void prefetch(std::size_t offset, std::size_t bytes) const;

  /// Throws IoError if the file's size or times differ from those when it was opened.
  void require_unchanged() const;

  /// Returns the file's identity when it was opened.
  FileIdentity identity() const;

 private:
  FileDescriptor file_;
  std::size_t size_ = 0;
  struct stat opened_ {};
};

}  // namespace detail
}  // namespace pcl_bv
