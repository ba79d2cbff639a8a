// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Smallest enclosing ball of a few points. Sphere fits use it for their candidate points.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// A ball around a few points, with the proof that it cannot be smaller.
struct SmallBall {
  /// Centre, in the coordinates of the points.
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double squared_radius = -1;  ///< The computed largest squared distance of a point; negative if no point.
  int support_size = 0;        ///< Number of support points, 1 to 4. They alone require this radius.
  std::array<std::size_t, 4> support{};  ///< Positions of the support points in the input.
  /// Weights w_i of the support points p_i, not negative, with sum 1. The centre is the weighted mean.
  std::array<double, 4> weights{};
  /// Lower bound of the squared radius of any enclosing ball, up to rounding. With c = sum w_i p_i, it is
  /// sum w_i |p_i - c|^2.
  double squared_lower_bound = 0;
};

/// Computes the smallest ball around the points. squared_radius and squared_lower_bound agree to about 1e-15.
/// Duplicate, collinear, coplanar and cospherical points are allowed. No point gives an empty ball.
/// Magnitudes should be from 1e-50 to 1e50, and coordinates should be relative to one of the points. O(count)
/// in practice, without allocation.
///
/// In each step the farthest point joins the support of at most four points (the pivoting of Gaertner 1999).
/// Of the balls that two, three or four of these five points span, the next ball is the one from which the
/// five points stick out least. No tolerance for flatness is needed. If a support is too flat for an accurate
/// solution, points stick out further from its ball, and another ball is taken.
///
/// `start`, if not null, is the ball that smallest_ball() returned for the first points of this array. It
/// saves the steps to that ball.
SmallBall smallest_ball(const Eigen::Vector3d* points, std::size_t count, const SmallBall* start = nullptr);

}  // namespace detail
}  // namespace pcl_bv
