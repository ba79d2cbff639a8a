// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// FIND-k-DOP: which points of a chunk reach farthest along the cube's directions. Floating-point vectors
// reject nearly all points; the few that are left are compared exactly.
#pragma once

#include <array>
#include <cstddef>

#include "pcl_bv/kernels/extreme_point.h"
#include "pcl_bv/kernels/isa.h"
#include "pcl_bv/kernels/point_view.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/directions.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// For each end (directions.h) of a set, a projection along end_direction() that some other point of the
/// cloud is known to reach; -infinity if none is. Points that do not reach it need not be found.
using ReachedEnds = std::array<double, kMaxEnds>;

inline constexpr ReachedEnds nothing_reached() {
  ReachedEnds reached{};
  for (double& r : reached)
    r = -kInfinity;
  return reached;
}

/// The extreme points of a chunk. Only the first 2 direction_count() ends count.
struct ChunkExtremes {
  std::array<ExtremePoint, kMaxEnds> ends{};  ///< Not found: no valid point, or none that reaches `reached`.
  std::size_t dropped = 0;                    ///< Points that are not valid (is_valid()).
};

/// Finds the extreme points of at most kChunkPoints points: the exactly greatest projection; of equal ones
/// the smallest index. Whether an end that cannot beat `reached` is found may depend on `isa`; any that is
/// found is the same for all. Paper §2 and §3. O(n); up to 220 KiB of stack. Runs in the caller's
/// floating-point environment: hold a FloatEnvironment. Throws std::invalid_argument for more points, and
/// unless they are in memory.
void chunk_extremes(UsableIsa isa, const PointView& chunk, DirectionSet set, const ReachedEnds& reached,
                    ChunkExtremes& out);

}  // namespace pcl_bv
