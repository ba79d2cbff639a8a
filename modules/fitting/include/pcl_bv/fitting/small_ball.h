// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The smallest enclosing ball of a few points: the solver that sphere fits hand their candidates to.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace pcl_bv {

/// A ball by centre and squared radius, of few points near the origin.
struct SmallBall {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double squared_radius = -1;  ///< Negative: no point.
};

/// The smallest ball around the points, to about 1e-14 of its radius; points of its surface may lie outside
/// by that much, so callers that promise enclosure measure again. Coordinates should be of the order of 1 and
/// relative to one of the points. Duplicates, collinear, coplanar and cospherical points are fine; no point
/// gives an empty ball.
///
/// Welzl 1991 with move-to-front and the pivoting of Gaertner 1999; for tens of points. Reorders `points`.
SmallBall smallest_ball(std::vector<Eigen::Vector3d>& points);

}  // namespace pcl_bv
