// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Transforms points with error bounds.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "pcl_bv/numeric/coordinates.h"

namespace pcl_bv::detail {

/// A transformed point, rounded, and a bound of the rounding errors in its coordinates.
struct TransformedPoint {
  Coordinates position;
  double error;
};

inline TransformedPoint transform_point(const Eigen::Isometry3d& pose, const Coordinates& p) {
  double sums[3], sizes = 0;
  for (int k = 0; k < 3; ++k) {
    const double x = pose(k, 0) * p.x, y = pose(k, 1) * p.y, z = pose(k, 2) * p.z;
    sums[k] = ((x + y) + z) + pose(k, 3);
    sizes += std::abs(x) + std::abs(y) + std::abs(z) + std::abs(pose(k, 3));
  }
  return {{sums[0], sums[1], sums[2]}, 0x1p-50 * sizes + 0x1p-500};
}

/// Returns an upper bound of |M v| / |v| for the linear part M of the pose. The square of this ratio is at
/// most the largest absolute row sum of M'M.
inline double max_stretch(const Eigen::Isometry3d& pose) {
  const Eigen::Matrix3d squares = pose.linear().transpose() * pose.linear();
  return std::sqrt(squares.cwiseAbs().rowwise().sum().maxCoeff()) * (1 + 0x1p-45);
}

}  // namespace pcl_bv::detail
