// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// POSIX files for both directions: an owned descriptor, and reasons in the words of the system.
#pragma once

#include <filesystem>
#include <string>
#include <utility>

namespace pcl_bv {

/// The system's words for an errno value, starting in lower case: "permission denied".
std::string system_reason(int error);

/// Owns an open descriptor.
class FileDescriptor {
 public:
  /// Opens as open(2) does, close-on-exec. Throws IoError: `context` and the system's reason.
  FileDescriptor(const std::filesystem::path& path, int flags, unsigned mode, const std::string& context);
  ~FileDescriptor();
  FileDescriptor(FileDescriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&&) = delete;

  int get() const { return fd_; }

  /// Closes now; returns errno, 0 if all went well.
  int close();

 private:
  int fd_;
};

}  // namespace pcl_bv
