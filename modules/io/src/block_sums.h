// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Checksums that detect changes between two reads of the same points even if the file's times do not show
// them.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_bv::detail {

/// One checksum of 2 bytes per block of kBlockPoints points. A billion points need 2 MB.
class BlockSums {
 public:
  explicit BlockSums(std::size_t points);

  /// Computes the checksums of all blocks that are completely in `records`. The records are the points
  /// [first, first + count). Incomplete blocks are ignored. Throws IoError if the checksum of a block differs
  /// from the checksum at the first read of the block. Thread-safe.
  void check(std::size_t first, std::size_t count, const std::byte* records, std::size_t step);

 private:
  std::size_t points_;
  std::vector<std::atomic<std::uint16_t>> sums_;  // by block; 0 if the block has not been read yet
};

}  // namespace pcl_bv::detail
