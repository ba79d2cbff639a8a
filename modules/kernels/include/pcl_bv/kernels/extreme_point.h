// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Which point reaches farthest along a direction, decided exactly.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "pcl_bv/kernels/exact_sum.h"
#include "pcl_bv/kernels/point_view.h"

namespace pcl_bv {

/// The point of greatest projection so far, and that projection.
struct ExtremePoint {
  bool found = false;
  ExactSum projection{};
  Coordinates point{};
  std::size_t index = 0;  ///< The cloud's number of the point.
};

/// Lets `best` compete with the view's valid points whose rounded projection (in the view's scalar type,
/// summed as (x +- y) +- z) is at least `threshold`. The exactly greatest wins; of equal ones the one with
/// the smallest index. O(n), scalar: meant for the few blocks that can hold an extreme.
void find_extreme_point(const PointView& points, const std::array<std::int8_t, 3>& direction,
                        double threshold, ExtremePoint& best);

}  // namespace pcl_bv
