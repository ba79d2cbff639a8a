// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Bounds of queries against the boxes of a VolumeTree, in the frame of the boxes.
#pragma once

#include <Eigen/Core>

#include "volume_boxes.h"

namespace pcl_bv::detail {

/// A query point in the frame of the boxes, and the margin by which bounds are extended.
struct FramePoint {
  Eigen::Vector3d at;
  /// Margin of each coordinate: VolumeBoxes::margin().
  double margin;

  FramePoint(const VolumeBoxes& boxes, const Coordinates& point);

  /// Returns whether distances to bounds can be computed. Beyond 2^500 the squares of distances leave the
  /// range of double.
  bool is_in_range() const { return at.cwiseAbs().maxCoeff() < 0x1p500; }
};

/// A ray `from.at + t * u`, in the frame of the boxes. The largest component of u is 1 to 2 in magnitude.
struct FrameRay {
  FramePoint from;
  Eigen::Vector3d u;
  int exponent;             ///< t in the frame is 2^exponent times t of the caller's ray.
  double underflow_margin;  ///< Bound of the error of `enter` and `exit` from underflow in intersect().

  FrameRay(const VolumeBoxes& boxes, const Coordinates& origin, const Coordinates& direction);
  /// Converts the parameter t of the caller's ray to t in the frame. Overflow gives infinity.
  double time(double t) const;
};

/// Returns a lower bound of the distance from a query point to a box, or 0 if the point may be inside.
double distance_to_box(const FramePoint& point, const BoxGroup& group, std::size_t k);

/// Returns a lower bound of the t at which a ray enters a box, or infinity if the ray misses it.
double enter_box(const FrameRay& ray, const BoxGroup& group, std::size_t k);

}  // namespace pcl_bv::detail
