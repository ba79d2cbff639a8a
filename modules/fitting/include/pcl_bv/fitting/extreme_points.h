// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// How far a cloud reaches along directions of your own, exactly, and which points reach there: what k-DOPs
// with own directions and the many-directional EPOS are made of. For the cube's directions extremes.h is
// faster.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "pcl_bv/fitting/execution.h"
#include "pcl_bv/fitting/result.h"
#include "pcl_bv/kernels/point_view.h"
#include "pcl_bv/kernels/projections.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// How far all points reach along one direction n, in units of n . p: of a point's coordinate if n has unit
/// length.
struct DirectionExtremes {
  double low = 0;           ///< Exact least n . p, rounded down to a double; never -0.
  double high = 0;          ///< Exact greatest n . p, rounded up to a double; never -0.
  FarthestPoint low_point;  ///< Of points with the same n . p the one with the smallest index.
  FarthestPoint high_point;
};

struct ExtremePoints {
  std::size_t used = 0;
  std::size_t dropped = 0;               ///< Points that are not valid (is_valid()).
  std::vector<DirectionExtremes> along;  ///< In the order of the directions; empty if no point is valid.
};

/// Finds the extremes of all valid points along each of `directions` (of any length, any signs, repeated or
/// not). The same bits for every execution. One SIMD pass over the points in chunks, which also looks exactly
/// at the few points of each chunk that can be extreme (docs/numerics.md): O(points * directions). Where the
/// extent of a float cloud is below 1e-43 or above 1e38 that is all of them, at 50 ns for each direction.
///
/// Throws std::invalid_argument unless there are 1 to 49 directions, each finite with its largest component
/// between 1e-30 and 1e30 in magnitude.
ExtremePoints find_extreme_points(const PointView& points,
                                  const std::vector<std::array<double, 3>>& directions,
                                  const Execution& execution = {});

}  // namespace pcl_bv
