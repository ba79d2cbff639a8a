// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Geometry>

#include "pcl_bv/volumes/hull.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Returns the view frustum of a camera, a pyramid cut off by two planes, as a hull of 8 vertices, 12
/// triangles and 6 planes. The result can be used like any other Hull.
///
/// `pose` is the transform from the camera's frame to the frame of the points. The camera is at the origin of
/// its frame; z is its viewing direction, x is to the right and y is down. This is the optical frame of ROS.
/// In the frame of pcl::FrustumCulling, in contrast, x is forward. In the camera's frame, the frustum is near
/// <= z <= far, |x| <= z horizontal_tan and |y| <= z vertical_tan. `horizontal_tan` and `vertical_tan` are
/// the tangents of half the fields of view. For a pinhole camera, horizontal_tan is (columns / 2) / fx.
///
/// Vertex i is at `far` if bit 2 of i is set, at positive x if bit 0 is set and at positive y if bit 1 is
/// set. The planes are near, far, positive x, negative x, positive y, negative y. Vertices are rounded. Each
/// plane is then moved outward, so that all rounded vertices lie exactly on its inner side or on it.
///
/// If `near` is 0, the frustum is a complete pyramid, with four vertices at the camera. Throws
/// std::invalid_argument unless 0 <= near < far <= 1e100 and both tangents are above 0 and at most 1e6. Also
/// throws unless each coordinate of the pose's translation is from -1e100 to 1e100 and the axes of the pose
/// are right-handed and orthonormal to 1e-6.
Hull frustum(const Eigen::Isometry3d& pose, double near, double far, double horizontal_tan,
             double vertical_tan);

}  // namespace pcl_bv
