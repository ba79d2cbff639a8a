// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The axis-aligned box, for those who do not ask which points touch it.
#pragma once

#include <array>
#include <cstddef>

#include "pcl_bv/points/isa.h"
#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Exact minimum and maximum of the valid points; +infinity and -infinity if there is none. Never -0.
struct AxisExtents {
  std::array<double, 3> low;
  std::array<double, 3> high;
  std::size_t dropped;  ///< Points with a coordinate that is not valid (is_valid()).
};

/// The same bits for every `isa`. O(n). Runs in the caller's floating-point environment: hold a
/// FloatEnvironment. Throws std::invalid_argument unless the points are in memory.
AxisExtents axis_extents(UsableIsa isa, const PointView& points);

}  // namespace pcl_bv
