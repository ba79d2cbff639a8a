// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Lower bounds of the distance of two convex bodies: the algorithm of Gilbert, Johnson and Keerthi proposes
// directions, and upper bounds of the bodies' supports along them prove the result.
#pragma once

#include <Eigen/Core>

#include "pcl_bv/volumes/pair_queries.h"
#include "shape.h"

namespace pcl_bv::volumes_internal {

/// A shape at its current pose: all points within `radius` of a point origin + rotation q, for the q of its
/// core.
struct PosedShape {
  explicit PosedShape(const ConvexBody& body);
  PosedShape(const SupportShape& point, const Eigen::Vector3d& at);

  /// As the functions of SupportShape, for the rotated points rotation q.
  Eigen::Vector3d support(const Eigen::Vector3d& direction) const;
  double support_value_up(const Eigen::Vector3d& direction) const;

  const SupportShape& shape;
  const Eigen::Matrix3d* rotation;  ///< Null for the identity.
  Eigen::Vector3d origin;
  double size, radius;  ///< `size` is an upper bound of |rotation q|.
};

/// The purpose of a search.
enum class Goal {
  distance,       ///< The distance.
  exceeds_bound,  ///< Whether the distance exceeds a bound: the search ends as soon as that is known.
};

/// Returns a lower bound of the distance, by exact arithmetic. 0 means that no positive bound was found; then
/// the bodies overlap or are only rounding errors apart. With Goal::exceeds_bound, the result exceeds `bound`
/// if the distance exceeds it by more than rounding errors. The order of a and b does not change the result.
double lower_bound(const PosedShape& a, const PosedShape& b, Goal goal, double bound);

}  // namespace pcl_bv::volumes_internal
