// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Files for what does not fit in memory.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace pcl_bv::detail {

/// A range of bytes in a SpillFile.
struct Extent {
  std::uint64_t offset = 0, bytes = 0;
};

/// Bytes that do not fit in memory. All functions may be called by several threads at the same time.
class SpillFile {
 public:
  /// Makes a file without a name in a folder, so the system frees its space when the process ends. An empty
  /// path is the system's folder of temporary files. Throws std::runtime_error with the reason.
  explicit SpillFile(const std::filesystem::path& folder);
  /// Opens an existing file to write from byte `begin` on, which is offset 0 of all functions. Throws as
  /// above.
  SpillFile(const std::filesystem::path& file, std::uint64_t begin);
  ~SpillFile();
  SpillFile(const SpillFile&) = delete;
  SpillFile& operator=(const SpillFile&) = delete;

  /// Appends bytes. Throws std::runtime_error if the disk is full or fails.
  Extent append(const void* bytes, std::size_t count);

  /// Appends bytes that are 0 until they are written. They take no space of the disk until then.
  void reserve(std::uint64_t bytes);

  /// Replaces bytes that were appended or reserved. Throws as append().
  void write(std::uint64_t offset, const void* bytes, std::size_t count);

  /// Reads bytes that were appended. Throws std::runtime_error if the disk fails.
  void read(std::uint64_t offset, void* to, std::size_t count) const;

  /// Frees the space of bytes that are not needed any more, if the file system can. Discarded data that is
  /// still in the page cache is never written to the disk.
  void discard(const Extent& extent);

 private:
  std::string name_;  // in messages
  int fd_ = -1;
  std::uint64_t begin_ = 0;
  std::atomic<std::uint64_t> end_ = 0;
};

/// A list of records that is written to a SpillFile in blocks.
class SpillList {
 public:
  /// Adds bytes to the list; writes a block when the buffer has `block_bytes`.
  void add(SpillFile& file, const void* bytes, std::size_t count, std::size_t block_bytes);
  /// Writes and frees the buffer.
  void finish(SpillFile& file);
  /// Reads all records into `to`, whose memory is used again. Call finish() before.
  void read(const SpillFile& file, std::vector<std::byte>& to) const;
  /// Frees the space of the records.
  void discard(SpillFile& file) const;

 private:
  std::vector<std::byte> buffer_;
  std::vector<Extent> extents_;
  std::uint64_t bytes_ = 0;
};

}  // namespace pcl_bv::detail
