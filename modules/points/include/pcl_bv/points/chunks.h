// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The blocks and chunks into which a cloud is cut by kernels and by callers that distribute kernels over
// cores. The sizes are fixed, so results do not depend on the number of threads.
#pragma once

#include <algorithm>
#include <cstddef>

#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Number of points per block. A kernel accepts or rejects a block as a whole (is any point invalid, can any
/// point be extreme?). A block of pcl::PointXYZ has 16 KiB, so a second pass finds it in the first-level
/// cache.
inline constexpr std::size_t kBlockPoints = 1024;

/// Number of points per chunk. One call of a kernel processes one chunk, in about 10 us. A chunk of
/// pcl::PointXYZ has 512 KiB, so a second kernel finds it in the second-level cache.
inline constexpr std::size_t kChunkPoints = 32 * kBlockPoints;

/// Returns the number of chunks of a cloud. The last chunk may be shorter than kChunkPoints.
constexpr std::size_t chunk_count(std::size_t points) {
  return (points + kChunkPoints - 1) / kChunkPoints;
}

/// Returns block number `block` of a view. The last block may be shorter than kBlockPoints.
inline PointView block_of(const PointView& points, std::size_t block) {
  const std::size_t begin = block * kBlockPoints;
  return points.slice(begin, std::min(kBlockPoints, points.count - begin));
}

}  // namespace pcl_bv
