// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Coordinates along axes that are orthonormal only to 1e-12. With U = 2^-53, the error bounds are 8 U = 2^-50
// of the sum of the magnitudes of the terms.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv::detail {

// The components y of d along the axes, with d = A y + r. The columns of A are the axes, which are nearly
// orthonormal. One step of refinement reduces r to rounding errors. `residual` is an upper bound of |r|,
// namely the sum of the magnitudes of r's components and of their error bounds. The error of a component is
// at most 4.01 U of its terms.
struct Components {
  Components(const Eigen::Matrix3d& axes, const Eigen::Vector3d& d) {
    for (int i = 0; i < 3; ++i)
      y[i] = dot3(axes.col(i), d);
    Eigen::Vector3d rest;
    for (int j = 0; j < 3; ++j)
      rest[j] = d[j] - dot3(axes.row(j), y);
    for (int i = 0; i < 3; ++i)
      y[i] += dot3(axes.col(i), rest);
    for (int j = 0; j < 3; ++j) {
      const double a = axes(j, 0) * y[0], b = axes(j, 1) * y[1], c = axes(j, 2) * y[2];
      const double terms = ((std::abs(a) + std::abs(b)) + std::abs(c)) + std::abs(d[j]);
      residual += std::abs(d[j] - ((a + b) + c)) + 0x1p-50 * terms;
    }
  }

  Eigen::Vector3d y;
  double residual = 0;
};

// Returns the dual basis q_i of the axes as columns: axis i . q_i = 1, and q_i is perpendicular to the other
// axes. Computes the basis from the axes by one correction of their deviation from orthonormal. The result is
// accurate to 1e-24.
inline Eigen::Matrix3d dual(const Eigen::Matrix3d& axes) {
  Eigen::Matrix3d result = axes;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double off = (i == j ? 1.0 : 0.0) - dot3(axes.col(i), axes.col(j));
      for (int k = 0; k < 3; ++k)
        result(k, i) += off * axes(k, j);
    }
  }
  return result;
}

inline Eigen::Vector3d linear_combination(const Eigen::Matrix3d& columns, const Eigen::Vector3d& s) {
  return {dot3(columns.row(0), s), dot3(columns.row(1), s), dot3(columns.row(2), s)};
}

// Upper bound of |q| / |s|, where s_i = axis i . q and the axes are orthonormal to 1e-12.
inline constexpr double kSkewFactor = 1 + 0x1p-36;

}  // namespace pcl_bv::detail
