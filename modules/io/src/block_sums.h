// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Checksums that detect changes between two reads of the same points when the file's times do not.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_bv {

/// A checksum of 2 bytes for each block of kBlockPoints points: 2 MB for a billion points.
class BlockSums {
 public:
  explicit BlockSums(std::size_t points);

  /// Computes the checksums of the blocks that are complete in these records, which are the points [first,
  /// first + count); incomplete blocks are ignored. Throws IoError if a block's checksum differs from that of
  /// its first read. Thread-safe.
  void check(std::size_t first, std::size_t count, const std::byte* records, std::size_t step);

 private:
  std::size_t points_;
  std::vector<std::atomic<std::uint16_t>> sums_;  // by block; 0: not read yet
};

}  // namespace pcl_bv
