// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Smallest enclosing ball of a few points. Sphere fits use it for their candidate points.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// A ball around a few points, with the proof that no smaller ball encloses these points.
struct SmallBall {
  /// Centre, in the coordinates of the points.
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double squared_radius = -1;  ///< The computed largest squared distance of a point. -1 without points.
  int support_size = 0;        ///< Number of support points, 1 to 4. Their smallest ball is this ball.
  std::array<std::size_t, 4> support{};  ///< Positions of the support points in the input.
  /// Weights w_i of the support points p_i, not negative, with sum 1. The centre is the weighted mean.
  std::array<double, 4> weights{};
  /// Lower bound of the squared radius of any enclosing ball, up to rounding. With c = sum w_i p_i, it is
  /// sum w_i |p_i - c|^2.
  double squared_lower_bound = 0;
};

/// Computes the smallest ball around the points. squared_radius and squared_lower_bound agree to about 1e-15.
/// Duplicate, collinear, coplanar and cospherical points are allowed. If count is 0, the ball is empty.
/// Coordinates should be relative to one of the points, and either 0 or from 1e-50 to 1e50 in magnitude.
/// O(count) in practice, without allocation.
///
/// In each step the farthest point joins the support of at most four points (the pivoting of Gaertner 1999).
/// The candidates for the next ball are the balls that the farthest point spans with one, two or three points
/// of the support. The candidate is taken whose centre has the smallest maximum distance from the support and
/// the farthest point. No tolerance for flatness is needed: if a support is too flat for an accurate
/// solution, this distance becomes larger, and another candidate is taken.
///
/// `start`, if not null, is the ball that smallest_ball() returned for the first points of `points`. The
/// search begins with this ball.
SmallBall smallest_ball(const Eigen::Vector3d* points, std::size_t count, const SmallBall* start = nullptr);

}  // namespace detail
}  // namespace pcl_bv
