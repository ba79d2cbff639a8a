// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Boxes seen from above, and how much two of them overlap.
#pragma once

#include <Eigen/Core>

namespace pcl_bv::bench {

/// An upright box seen from above: a rectangle, metres. `yaw` is the angle from x to the length, radians.
struct GroundBox {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  double yaw = 0, length = 0, width = 0;

  double area() const { return length * width; }
};

/// Returns the bird's-eye IoU: the area of the intersection divided by that of the union. Rectangles without
/// area give 0.
double ground_iou(const GroundBox& a, const GroundBox& b);

}  // namespace pcl_bv::bench
