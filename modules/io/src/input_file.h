// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Input by position with pread, not mmap: a file cut while it is read must give an error, not SIGBUS.
#pragma once

#include <sys/stat.h>

#include <cstddef>
#include <filesystem>

#include "file_descriptor.h"
#include "pcl_bv/io/io_error.h"

namespace pcl_bv {

/// A regular file open for reading.
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
  void expect(std::size_t offset, std::size_t bytes) const;

 private:
  void require_unchanged() const;

  FileDescriptor file_;
  std::size_t size_ = 0;
  struct stat opened_ {};
};

}  // namespace pcl_bv
