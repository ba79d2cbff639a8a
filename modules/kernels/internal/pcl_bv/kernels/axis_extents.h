// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Finds the axis-aligned bounding box of a cloud, but not the points that touch the box.
#pragma once

#include <array>
#include <cstddef>

#include "pcl_bv/points/isa.h"
#include "pcl_bv/points/point_view.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Exact minimum and maximum coordinates of the valid points. Without valid points `low` is +infinity and
/// `high` is -infinity. No coordinate is -0.
struct AxisExtents {
  std::array<double, 3> low;
  std::array<double, 3> high;
  std::size_t dropped;  ///< Number of points that are not valid (is_valid()).
};

/// Returns the axis-aligned extents of the points. The result has the same bits for every `isa`. O(n). The
/// caller must hold a FloatEnvironment. Throws std::invalid_argument if the points are not in memory.
AxisExtents axis_extents(UsableIsa isa, const PointView& points);

}  // namespace detail
}  // namespace pcl_bv
