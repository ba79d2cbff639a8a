// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Which point reaches farthest along a direction, decided exactly.
#pragma once

#include <cstddef>

#include "pcl_bv/kernels/point_view.h"
#include "pcl_bv/numeric/directions.h"
#include "pcl_bv/numeric/exact_sum.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// The point of greatest projection so far, and that projection.
struct ExtremePoint {
  bool found = false;
  ExactSum projection{};
  Coordinates point{};
  std::size_t index = 0;  ///< The cloud's number of the point.
};

/// Lets `best` compete with another one: the exactly greater projection wins; of equal ones the smaller
/// index.
void keep_extreme(const ExtremePoint& other, ExtremePoint& best);

/// Which points are worth an exact look: those whose rounded projection, relative to `center` and in the
/// view's scalar type, summed as ((x - cx) +- (y - cy)) +- (z - cz), is at least `threshold` (a value of that
/// type).
struct RoundedFilter {
  Coordinates center;
  double threshold;
};

/// Lets `best` compete with those valid points first, first + step, ... below `end` that pass the filter.
/// O(points visited), scalar: meant for the few that can be extreme. Throws std::invalid_argument unless the
/// points are in memory, std::out_of_range for an `end` behind the last one.
void find_extreme_point(const PointView& points, std::size_t first, std::size_t step, std::size_t end,
                        const CubeDirection& direction, const RoundedFilter& filter, ExtremePoint& best);

}  // namespace pcl_bv
