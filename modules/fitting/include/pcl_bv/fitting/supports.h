// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// How far a cloud reaches along directions, exactly, and which points reach there: what boxes, k-DOPs and the
// seeds of spheres are made of.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "pcl_bv/fitting/execution.h"
#include "pcl_bv/fitting/result.h"
#include "pcl_bv/kernels/support.h"
#include "pcl_bv/numeric/directions.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/volumes/aabb.h"
#include "pcl_bv/volumes/kdop.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// How far all points reach along one direction n, in units of n . p: of a point's coordinate if n has unit
/// length.
struct Support {
  double low = 0;          ///< Exact least n . p, rounded down to a double; never -0.
  double high = 0;         ///< Exact greatest n . p, rounded up to a double; never -0.
  SupportPoint low_point;  ///< Of points with the same n . p the one with the smallest index.
  SupportPoint high_point;
};

enum class SupportDetail {
  bounds,  ///< How far only: all that a box needs, four times as fast along the axes alone.
  points   ///< Also the points.
};

struct LocalHull;
struct Moments;

/// Along the cube's directions.
struct Supports {
  DirectionSet set = DirectionSet::dop6;
  SupportDetail detail = SupportDetail::bounds;  ///< What there is.
  std::size_t used = 0;
  std::size_t dropped = 0;
  int rank = 0;  ///< Of the points, as result.h defines it.
  /// The first direction_count(set) count; they follow kCubeDirections as cube_direction() says.
  std::array<Support, kMaxDirections> along{};
  PointView points;                       ///< Whose supports they are: only compared with, never read again.
  std::shared_ptr<const LocalHull> hull;  ///< For the fits that need it, where share_supports() found it.
  /// Where `points` are few that stand for a cloud (partial.h), of all points of the cloud, as `used` is.
  std::shared_ptr<const Moments> moments;
};

/// Finds the supports of all valid points; `used` is 0 and nothing else but `dropped` is set if there is
/// none. The same bits for every execution. One SIMD pass over the points in chunks, which also looks exactly
/// at the few points of each chunk that can be extreme (docs/numerics.md). None if Execution::supports has
/// them; throws std::invalid_argument if those are of other points. Points that are flat but for 2^-30 of
/// their extent, and not just across a coordinate axis, are passed over up to five times more for their rank.
Supports find_supports(const PointView& points, DirectionSet set, SupportDetail detail,
                       const Execution& execution);

/// The box of the supports along the axes and the k-DOP of all of them; empty if there was no valid point.
Aabb aabb_of(const Supports& supports);
Kdop kdop_of(const Supports& supports);

/// Status and rank as result.h defines them.
EstimationResult result_of(const Supports& supports);

/// Along directions of your own.
struct OwnSupports {
  std::size_t used = 0;
  std::size_t dropped = 0;     ///< Points that are not valid (is_valid()).
  std::vector<Support> along;  ///< In the order of the directions; empty if no point is valid.
};

/// The same for directions of any length and any signs, repeated or not, in O(points * directions). Where the
/// extent of a float cloud is below 1e-43 or above 1e38 all points are looked at exactly, at 50 ns for each
/// direction.
///
/// Throws std::invalid_argument unless there are 1 to 49 directions, each finite with its largest component
/// between 1e-30 and 1e30 in magnitude.
OwnSupports find_supports(const PointView& points, const std::vector<std::array<double, 3>>& directions,
                          const Execution& execution = {});

}  // namespace pcl_bv
