// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// How kernels and the callers who spread them over cores cut a cloud. No result depends on it.
#pragma once

#include <algorithm>
#include <cstddef>

#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Points per block: what a kernel judges as a whole (is any point invalid, can any be extreme?). 16 KiB of
/// pcl::PointXYZ, so a second look finds it in the first-level cache.
inline constexpr std::size_t kBlockPoints = 1024;

/// Points per chunk: what one call of a kernel works on, some 10 us. 512 KiB of pcl::PointXYZ, so a second
/// kernel finds it in the second-level cache.
inline constexpr std::size_t kChunkPoints = 32 * kBlockPoints;

constexpr std::size_t chunk_count(std::size_t points) {
  return (points + kChunkPoints - 1) / kChunkPoints;
}

inline PointView block_of(const PointView& points, std::size_t block) {
  const std::size_t begin = block * kBlockPoints;
  return points.slice(begin, std::min(kBlockPoints, points.count - begin));
}

}  // namespace pcl_bv
