// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Converts the points of a sensor to another coordinate frame.
#pragma once

#include <array>
#include <cstddef>

#include "pcl_bv/points/isa.h"
#include "pcl_bv/points/point_view.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// The upper three rows of a rigid transform: rotation and, in the last column, translation.
using RigidTransform = std::array<std::array<double, 4>, 3>;

/// Writes the transformed position of each point. `xyz` gets x, y and z of all points without gaps, in the
/// scalar type of the points. Points at (0, 0, 0) have no return. They become NaN, as do points that are not
/// valid before or after the transform. Otherwise a point without a return would be at the position of the
/// sensor in the new frame, and could not be distinguished from a measured one.
///
/// The bits are the same for every `isa`: each operation is rounded to the scalar type. The caller must hold
/// a FloatEnvironment. O(points). Throws std::invalid_argument if the points are not in memory.
void transform_points(UsableIsa isa, const PointView& points, const RigidTransform& transform,
                      std::byte* xyz);

}  // namespace detail
}  // namespace pcl_bv
