// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv::volumes_internal {

/// The vector if it is of length 1 to 2^-50 already, else made so: what was normalised once stays as it is.
inline Eigen::Vector3d unit_axis(const Eigen::Vector3d& v) {
  const Eigen::Vector3d unit = std::abs(dot3(v, v) - 1) <= 0x1p-50 ? v : v.stableNormalized();
  return unit.array() + 0.0;
}

/// An axis and two unit vectors across it, right-handed.
struct Triad {
  explicit Triad(const Eigen::Vector3d& a) : axis(a) {
    Eigen::Index least = 0;
    a.cwiseAbs().minCoeff(&least);
    u = Eigen::Vector3d::Unit(least).cross(a).stableNormalized();
    v = a.cross(u);
  }
  Eigen::Vector3d axis, u, v;
};

}  // namespace pcl_bv::volumes_internal
