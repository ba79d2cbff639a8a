// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Writes files that other programs read while they grow. Each write is whole, and each file has one writer.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "pcl_bv/io/posix_file.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Writes all bytes to a descriptor, by one system call if the system takes all bytes at once. Returns 0, or
/// the errno value of the failure.
///
/// After a failure, such as a full disk, a regular file has its former end: the bytes that were written are
/// removed. `overwritten` is the old content at the position of `bytes`, and is written again. If another
/// program has appended to the file meanwhile, nothing is removed, and a part of `bytes` stays in the file.
/// Bytes that a pipe or a device took cannot be removed.
int write_whole(int descriptor, std::string_view bytes, std::string_view overwritten = {});

/// A file that is written piece by piece. No other GrowingFile of this machine writes to the same regular
/// file meanwhile: the file is locked (fcntl, F_OFD_SETLK) until it is closed or the process ends.
class GrowingFile {
 public:
  /// Opens the file, or creates it with mode 0644 without the bits of the umask. Follows symbolic links, also
  /// to a missing file. The content stays until the first call of append() or close(). Throws IoError if the
  /// file cannot be opened or is locked. File systems without locks are not locked.
  explicit GrowingFile(const std::filesystem::path& file);
  /// Removes the file if this object created it, and neither append() nor close() succeeded.
  ~GrowingFile();
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;

  /// Appends the bytes as write_whole() does. The next call overwrites the last `tail` of them. The first
  /// call empties a regular file before. Returns 0, or the errno value of the failure.
  int append(std::string_view bytes, std::size_t tail = 0);

  /// Closes the file. Empties it before if nothing was appended. Returns 0, or the errno value of the
  /// failure: written data may be lost.
  int close();

 private:
  FileDescriptor open(const std::filesystem::path& file);
  int begin();

  std::filesystem::path created_;  // the file while the destructor must remove it, otherwise empty
  FileDescriptor file_;
  std::string tail_;
  bool begun_ = false;
};

/// Locks a folder for the files that this process writes to it, until the last copy of the returned pointer
/// is destroyed or the process ends (flock). Throws IoError if another process has locked the folder, or if
/// `exclusive` and another call of this process has. Returns null if the folder cannot be opened or its file
/// system has no locks.
std::shared_ptr<const FileDescriptor> lock_folder(const std::filesystem::path& folder, bool exclusive = false);

}  // namespace detail
}  // namespace pcl_bv
