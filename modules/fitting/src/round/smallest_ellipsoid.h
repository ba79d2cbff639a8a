// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The smallest enclosing ellipsoid of points, computed by exchanges of weight between points.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace pcl_bv::detail {

/// Weights of points, and the ellipsoid that they define. Let S be the weighted covariance of the points and
/// d the number of dimensions. No ellipsoid around these points has a volume below sqrt(d^d det S) times the
/// volume of the unit ball.
struct WeightedEllipsoid {
  std::vector<double> weights;  ///< One weight per point, not negative, with sum 1.
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< S; rows and columns beyond d are zero.
  int iterations = 0;
};

/// Computes the smallest ellipsoid of points. Uses only the first `dimensions` coordinates, which should be
/// about 1. The points must span all of these dimensions. In the end, all points satisfy
/// (p - center)' S^-1 (p - center) <= dimensions + (dimensions + 1) tolerance, unless `most_iterations` stops
/// the solver before. O(points) for each iteration. Usually 20 to 100 iterations are enough.
///
/// Exchanges weight between pairs of points (Boehning 1986). First the point farthest outside exchanges
/// weight with all points that have weight. Then these points exchange weight with one another, as in Harman,
/// Filova and Richtarik 2020, who use a random order.
WeightedEllipsoid smallest_ellipsoid(const std::vector<Eigen::Vector3d>& points, int dimensions,
                                     double tolerance, int most_iterations);

}  // namespace pcl_bv::detail
