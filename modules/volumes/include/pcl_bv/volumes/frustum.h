// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Geometry>

#include "pcl_bv/volumes/hull.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// What a camera sees: a pyramid cut off by two planes, as a hull of 8 vertices, 12 triangles and 6 planes,
/// so that every verb of volumes and every query works on it.
///
/// The camera is at the origin of `pose`, from whose frame the pose leads to that of the points. It looks
/// along its z axis, x to the right and y down: ROS's optical frames, not the x forward of
/// pcl::FrustumCulling. Points seen are near <= z <= far, |x| <= z horizontal_tan, |y| <= z vertical_tan;
/// each tangent is of half the field of view, so the first is (columns / 2) / fx of a pinhole camera.
///
/// Vertices are rounded and each plane is moved outward until it holds all of them, by exact arithmetic:
/// vertex i is at far where bit 2 of i is set, at positive x for bit 0, at positive y for bit 1; planes are
/// near, far, positive x, negative x, positive y, negative y.
///
/// `near` 0 is a whole pyramid. Throws std::invalid_argument unless 0 <= near < far <= 1e100, both tangents
/// are above 0 and at most 1e6, and the pose is finite, its axes unit and orthogonal to 1e-6 and
/// right-handed.
Hull frustum(const Eigen::Isometry3d& pose, double near, double far, double horizontal_tan,
             double vertical_tan);

}  // namespace pcl_bv
