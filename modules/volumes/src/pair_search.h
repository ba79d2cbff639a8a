// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The distance of two convex bodies: Gilbert, Johnson and Keerthi's algorithm proposes directions, and bounds
// of how far the bodies reach along them prove what is answered.
#pragma once

#include <Eigen/Core>

#include "pcl_bv/volumes/pairs.h"
#include "shape.h"

namespace pcl_bv::volumes_internal {

/// A shape where it stands: all origin + turn q for the q of its core, and everything within a radius of
/// these.
struct Placed {
  explicit Placed(const ConvexBody& body);
  Placed(const Shape& point, const Eigen::Vector3d& at);

  /// As those of Shape, of turn q.
  Eigen::Vector3d support(const Eigen::Vector3d& direction) const;
  double reach_up(const Eigen::Vector3d& direction) const;

  const Shape& shape;
  const Eigen::Matrix3d* turn;  ///< Null: none.
  Eigen::Vector3d origin;
  double size, radius;  ///< No turn q is longer than size.
};

/// What a search is for.
enum class Goal {
  best,    ///< The distance.
  enough,  ///< Whether it exceeds a bound: the search ends when that is known.
};

/// A lower bound of the distance by exact arithmetic; 0: none above 0 was found, none is more than rounding
/// away from one. Goal::enough: above `bound`, if the distance is by more than rounding. The same for both
/// orders.
double lower_bound(const Placed& a, const Placed& b, Goal goal, double bound);

}  // namespace pcl_bv::volumes_internal
