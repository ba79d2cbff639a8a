// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// How far a cloud reaches along the cube's directions, exactly, and which points reach there: what boxes,
// k-DOPs and the seeds of spheres are made of.
#pragma once

#include <array>
#include <cstddef>

#include "pcl_bv/fitting/execution.h"
#include "pcl_bv/fitting/result.h"
#include "pcl_bv/kernels/extreme_point.h"
#include "pcl_bv/kernels/point_view.h"
#include "pcl_bv/numeric/directions.h"
#include "pcl_bv/volumes/aabb.h"
#include "pcl_bv/volumes/kdop.h"

namespace [[gnu::visibility("default")]] pcl_bv {

enum class ExtremeDetail {
  bounds,  ///< How far only: all that a box needs, four times as fast along the axes alone.
  points   ///< Also the points; for equal projections the one with the smallest index.
};

/// The first direction_count(set) entries count; they follow kCubeDirections as cube_direction() says.
struct Extremes {
  DirectionSet set = DirectionSet::dop6;
  ExtremeDetail detail = ExtremeDetail::bounds;  ///< What was asked for; there may be more.
  std::size_t used = 0;
  std::size_t dropped = 0;
  int rank = 0;                              ///< Of the points, as result.h defines it.
  std::array<double, kMaxDirections> low{};  ///< Exact least projection, rounded down to a double; never -0.
  std::array<double, kMaxDirections>
      high{};  ///< Exact greatest projection, rounded up to a double; never -0.
  std::array<ExtremePoint, kMaxDirections> low_point{};   ///< With ExtremeDetail::points.
  std::array<ExtremePoint, kMaxDirections> high_point{};  ///< With ExtremeDetail::points.
  PointView points;  ///< What they are the extremes of: only compared with, never read again.
};

/// Finds the extremes of all valid points; `used` is 0 and nothing else but `dropped` is set if there is
/// none. The same bits for every execution. One SIMD pass over the points in chunks, which also looks exactly
/// at the few points of each chunk that can be extreme (docs/numerics.md). None if Execution::extremes has
/// them; throws std::invalid_argument if those are of other points. Points that are flat but for 2^-30 of their
/// extent, and not just across a coordinate axis, are passed over up to five times more for their rank.
Extremes find_extremes(const PointView& points, DirectionSet set, ExtremeDetail detail,
                       const Execution& execution);

/// The box of the extremes along the axes and the k-DOP of all of them; empty if there was no valid point.
Aabb aabb_of(const Extremes& extremes);
Kdop kdop_of(const Extremes& extremes);

/// Status and rank as result.h defines them.
EstimationResult result_of(const Extremes& extremes);

}  // namespace pcl_bv
