// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The smallest enclosing ball of a few points: the solver that sphere fits hand their candidates to.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

namespace [[gnu::visibility("default")]] pcl_bv {

/// A ball of few points, and why it cannot be smaller.
struct SmallBall {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double squared_radius = -1;  ///< The greatest squared distance of a point, as measured; negative: no point.
  int support_size = 0;        ///< 1 to 4 points that alone ask for a ball of this size.
  std::array<std::size_t, 4> support{};  ///< Their positions in the input.
  std::array<double, 4> weights{};       ///< Not negative, sum 1: the centre is their weighted mean.
  /// No smaller squared radius is possible, up to rounding: with c = sum w_i p_i, the sum of w_i |p_i - c|^2.
  double squared_lower_bound = 0;
};

/// The smallest ball around the points: squared_radius and squared_lower_bound agree to about 1e-15.
/// Duplicates, collinear, coplanar and cospherical points are fine; no point gives an empty ball. Magnitudes
/// should be from 1e-50 to 1e50 and relative to one of the points. O(count) in practice; no allocation.
///
/// The farthest point joins the at most four that support the ball (the pivoting of Gaertner 1999); the ball
/// of these five is, of those spanned by two, three or four of them, the one that leaves the least outside.
/// No tolerance decides what is flat: a support too flat to be solved leaves more outside and is not taken.
///
/// `start`, a ball of this function for the first of these points, saves the steps that led to it.
SmallBall smallest_ball(const Eigen::Vector3d* points, std::size_t count, const SmallBall* start = nullptr);

}  // namespace pcl_bv
