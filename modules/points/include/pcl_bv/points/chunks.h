// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// How kernels, and callers that distribute them over cores, cut a cloud into blocks and chunks. The sizes are
// fixed, so results do not depend on the number of threads.
#pragma once

#include <algorithm>
#include <cstddef>

#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Points per block, the unit that a kernel accepts or rejects as a whole (is any point invalid, can any
/// point be extreme?). 16 KiB of pcl::PointXYZ: a second pass finds the block in the first-level cache.
inline constexpr std::size_t kBlockPoints = 1024;

/// Points per chunk, the unit of one kernel call (about 10 us). 512 KiB of pcl::PointXYZ: a second kernel
/// finds the chunk in the second-level cache.
inline constexpr std::size_t kChunkPoints = 32 * kBlockPoints;

/// Returns the number of chunks of a cloud; the last one may be shorter.
constexpr std::size_t chunk_count(std::size_t points) {
  return (points + kChunkPoints - 1) / kChunkPoints;
}

/// Returns block number `block` of a view; the last one may be shorter.
inline PointView block_of(const PointView& points, std::size_t block) {
  const std::size_t begin = block * kBlockPoints;
  return points.slice(begin, std::min(kBlockPoints, points.count - begin));
}

}  // namespace pcl_bv
