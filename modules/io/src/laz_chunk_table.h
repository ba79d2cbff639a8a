// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reads the table of chunks of a .laz file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "pcl_bv/io/posix_file.h"

namespace pcl_bv::detail {

/// The table at a byte of the file: a version (u32, 0), the number of chunks (u32), and their points and
/// bytes, which LASzip's arithmetic coder has compressed. The entries are decoded one after another, and so
/// need no memory.
class ChunkTableReader {
 public:
  struct Entry {
    std::uint32_t points = 0;  ///< 0 if all chunks have the same number.
    std::uint32_t bytes = 0;
  };

  /// Reads the beginning of the table. `with_points` says whether an entry has a number of points. Throws
  /// IoError if the table is truncated or of another version.
  ChunkTableReader(const InputFile& file, std::size_t offset, bool with_points);
  ~ChunkTableReader();
  ChunkTableReader(const ChunkTableReader&) = delete;
  ChunkTableReader& operator=(const ChunkTableReader&) = delete;

  /// Returns the number of entries that the table announces.
  std::uint32_t size() const { return size_; }

  /// Returns the next entry. Call it at most size() times. Throws IoError if the table is truncated or
  /// damaged.
  Entry next();

 private:
  class Decoder;

  bool with_points_;
  std::uint32_t size_ = 0;
  Entry last_;
  std::unique_ptr<Decoder> decoder_;
};

}  // namespace pcl_bv::detail
