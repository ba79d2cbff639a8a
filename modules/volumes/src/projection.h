// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Projections of points on directions, with error bounds.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "pcl_bv/numeric/constants.h"

namespace pcl_bv::detail {

/// A projection computed in plain double, and its error bound. Three products and two sums are off by at most
/// 3.01 * 2^-53 of the sum of the products' magnitudes. The error bound is 4 * 2^-53 of this sum, plus the
/// smallest normal number for products that underflow.
struct Projection {
  double value, error;

  /// Bounds of the exact projection. The factor 2 also covers the rounding errors of low() and high().
  double low() const { return value - 2 * error; }
  double high() const { return value + 2 * error; }
};

inline Projection project(const Eigen::Vector3d& n, const Eigen::Vector3d& p) {
  const double x = p.x() * n.x(), y = p.y() * n.y(), z = p.z() * n.z();
  return {(x + y) + z, 0x1p-51 * ((std::abs(x) + std::abs(y)) + std::abs(z)) + kSmallestNormal};
}

}  // namespace pcl_bv::detail
