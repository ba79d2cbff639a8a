// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// How far a cloud reaches along three axes, in double, for those who know what to do about its rounding:
// oriented boxes.
#pragma once

#include <array>
#include <cstddef>

#include "pcl_bv/numeric/exact_dot.h"
#include "pcl_bv/points/isa.h"
#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Along each axis the least and greatest (nx qx + ny qy) + nz qz, q = p - origin, each step rounded to
/// double, of the valid points and of the origin, whose is 0. Never -0.
struct SlabExtents {
  std::array<double, 3> low{};
  std::array<double, 3> high{};
};

/// `origin` must be a valid point of the cloud, axes up to 1e150. The same bits for every `isa`. O(n). Runs
/// in the caller's floating-point environment: hold a FloatEnvironment. Throws std::invalid_argument for an
/// origin that is not valid or not of the cloud's scalar type, and unless the points are in memory.
SlabExtents slab_extents(UsableIsa isa, const PointView& points, const Coordinates& origin,
                         const std::array<Direction, 3>& axes);

}  // namespace pcl_bv
