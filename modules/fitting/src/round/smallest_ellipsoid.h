// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace pcl_bv {

/// A distribution over points and what it proves: with S its covariance, no ellipsoid around these points has
/// a smaller volume than (unit ball) * sqrt(dimensions^dimensions det S).
struct WeightedEllipsoid {
  std::vector<double> weights;  ///< One per point, not negative, sum 1.
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< S; zero beyond `dimensions`.
  int iterations = 0;
};

/// Of points that span so many dimensions, in their first so many coordinates, which should be about 1. The
/// ellipsoid dimensions >= (p - center)' S^-1 (p - center) grows by at most (1 + 4/3 tolerance) to hold all
/// points, unless `most_iterations` are spent before. O(points) each; some 20 to 100 are enough.
///
/// Exchanges of weight between pairs (Boehning 1986), best with all others first and then among those that
/// have any, as Harman, Filova and Richtarik 2020 do in random order.
WeightedEllipsoid smallest_ellipsoid(const std::vector<Eigen::Vector3d>& points, int dimensions,
                                     double tolerance, int most_iterations);

}  // namespace pcl_bv
