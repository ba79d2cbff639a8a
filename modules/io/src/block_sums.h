// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Whether what is read again is what was read first, where the file's times do not tell.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_bv {

/// A checksum of each kBlockPoints points, 2 bytes: 2 MB of a billion points.
class BlockSums {
 public:
  explicit BlockSums(std::size_t points);

  /// Sums the blocks that lie whole in these records, points [first, first + count); blocks of which only a
  /// part was read are left out. Throws IoError if one was read before and was another then. For several
  /// threads at a time.
  void check(std::size_t first, std::size_t count, const std::byte* records, std::size_t step);

 private:
  std::size_t points_;
  std::vector<std::atomic<std::uint16_t>> sums_;  // 0: not read yet
};

}  // namespace pcl_bv
