// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Lower bounds of the distance of two convex bodies: the algorithm of Gilbert, Johnson and Keerthi proposes
// directions, and upper bounds of the bodies' supports along them prove the result.
#pragma once

#include <Eigen/Core>

#include "pcl_bv/volumes/pair_queries.h"
#include "shape.h"

namespace pcl_bv::volumes_internal {

/// A shape at its current pose: all points within `radius` of a point origin + turn q, for the q of its core.
struct Placed {
  explicit Placed(const ConvexBody& body);
  Placed(const Shape& point, const Eigen::Vector3d& at);

  /// As the functions of Shape, for the rotated points turn q.
  Eigen::Vector3d support(const Eigen::Vector3d& direction) const;
  double support_value_up(const Eigen::Vector3d& direction) const;

  const Shape& shape;
  const Eigen::Matrix3d* turn;  ///< Null for the identity.
  Eigen::Vector3d origin;
  double size, radius;  ///< `size` is an upper bound of |turn q|.
};

/// The purpose of a search.
enum class Goal {
  best,    ///< The distance.
  enough,  ///< Whether the distance exceeds a bound: the search ends as soon as that is known.
};

/// Returns a lower bound of the distance, by exact arithmetic. 0 means that no positive bound was found; then
/// the bodies overlap or are only rounding errors apart. With Goal::enough, the result exceeds `bound` if the
/// distance exceeds it by more than rounding errors. The order of a and b does not change the result.
double lower_bound(const Placed& a, const Placed& b, Goal goal, double bound);

}  // namespace pcl_bv::volumes_internal
