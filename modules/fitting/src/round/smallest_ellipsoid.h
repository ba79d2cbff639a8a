// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The smallest enclosing ellipsoid of points, by exchanges of weight between points.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace pcl_bv {

/// Weights of points, and the ellipsoid that they define. With S their weighted covariance and d the number
/// of dimensions, no ellipsoid around these points has a volume below that of the unit ball times
/// sqrt(d^d det S).
struct WeightedEllipsoid {
  std::vector<double> weights;  ///< One per point, not negative, sum 1.
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< S; rows and columns beyond d are zero.
  int iterations = 0;
};

/// Computes the smallest ellipsoid of points that span `dimensions` dimensions in their first `dimensions`
/// coordinates, which should be about 1. In the end, all points satisfy (p - center)' S^-1 (p - center) <=
/// dimensions + (dimensions + 1) tolerance, unless `most_iterations` are spent before. O(points) for each
/// iteration; some 20 to 100 iterations are enough.
///
/// Exchanges weight between pairs of points (Boehning 1986): first the point farthest outside with all points
/// that have weight, then these points with one another, as Harman, Filova and Richtarik 2020 do in random
/// order.
WeightedEllipsoid smallest_ellipsoid(const std::vector<Eigen::Vector3d>& points, int dimensions,
                                     double tolerance, int most_iterations);

}  // namespace pcl_bv
