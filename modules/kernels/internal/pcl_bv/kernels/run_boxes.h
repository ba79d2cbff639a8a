// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Boxes around runs of consecutive points. Consecutive points of a sensor are mostly neighbours, so these
// boxes are small.
#pragma once

#include <cstddef>

#include "pcl_bv/points/isa.h"
#include "pcl_bv/points/point_view.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Number of points in a run. One coordinate of a run of floats fills four AVX-512 vectors.
inline constexpr std::size_t kRunPoints = 64;

/// Minimum and maximum of each coordinate of a run. For double points they are rounded outward to float. low
/// is +infinity and high -infinity if all values of a coordinate are NaN.
struct RunBox {
  float low[3], high[3];
};

/// Sets boxes[r] to the box around the visited points 64 r to 64 r + 63. Only NaN coordinates are ignored;
/// the point's other coordinates and infinities count. `boxes` needs points.count / 64 elements, rounded up.
/// The boxes are the same for every `isa`. O(n). The caller must hold a FloatEnvironment. Throws
/// std::invalid_argument if the points are not in memory.
void run_boxes(UsableIsa isa, const PointView& points, RunBox* boxes);

}  // namespace detail
}  // namespace pcl_bv
