// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Lower bounds of the distance of two convex bodies. The algorithm of Gilbert, Johnson and Keerthi proposes
// directions. Upper bounds of the bodies' support values along these directions prove the result.
#pragma once

#include <Eigen/Core>

#include "pcl_bv/volumes/pair_queries.h"
#include "shape.h"

namespace pcl_bv::detail {

/// A shape at its current pose. The shape consists of all points within `radius` of the points `origin +
/// rotation * q`, where q is any point of the shape's core.
struct PosedShape {
  explicit PosedShape(const ConvexBody& body);
  PosedShape(const SupportShape& point, const Eigen::Vector3d& at);

  /// Same as the functions of SupportShape, but for the rotated core, whose points are rotation q.
  Eigen::Vector3d support(const Eigen::Vector3d& direction) const;
  double support_value_up(const Eigen::Vector3d& direction) const;

  const SupportShape& shape;
  const Eigen::Matrix3d* rotation;  ///< Null for the identity.
  Eigen::Vector3d origin;
  double size, radius;  ///< `size` is an upper bound of |rotation q| over the core.
};

/// What a search computes.
enum class Goal {
  distance,       ///< The distance.
  exceeds_bound,  ///< Whether the distance exceeds a bound. The search ends when this is known.
};

/// Returns a proven lower bound of the distance. The result is 0 if the bodies overlap or if their distance
/// is within rounding errors. With Goal::exceeds_bound, the result exceeds `bound` if the distance exceeds
/// `bound` by more than rounding errors. The order of a and b does not change the result.
double lower_bound(const PosedShape& a, const PosedShape& b, Goal goal, double bound);

}  // namespace pcl_bv::detail
