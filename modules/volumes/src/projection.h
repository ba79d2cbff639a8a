// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A point seen along a direction, with what rounding may do to it.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "pcl_bv/numeric/constants.h"

namespace pcl_bv::volumes_internal {

/// A projection in plain double and a bound of its error. Three products and two sums are off by at most
/// 3.01 2^-53 of the sum of magnitudes; the smallest normal covers products that underflow.
struct Projection {
  double value, error;

  /// Twice the error away, so that the two hold the exact projection after their own rounding.
  double low() const { return value - 2 * error; }
  double high() const { return value + 2 * error; }
};

inline Projection project(const Eigen::Vector3d& n, const Eigen::Vector3d& p) {
  const double x = p.x() * n.x(), y = p.y() * n.y(), z = p.z() * n.z();
  return {(x + y) + z, 0x1p-51 * ((std::abs(x) + std::abs(y)) + std::abs(z)) + kSmallestNormal};
}

}  // namespace pcl_bv::volumes_internal
