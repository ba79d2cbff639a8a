// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// An orthonormal basis of the plane perpendicular to an axis.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv::detail {

/// Two orthogonal unit vectors perpendicular to the unit vector `axis`. (u, v, axis) is right-handed.
struct PlaneBasis {
  explicit PlaneBasis(const Eigen::Vector3d& axis) {
    Eigen::Vector3d least_aligned = Eigen::Vector3d::UnitX();
    if (std::abs(axis.y()) < std::abs(axis.x())) least_aligned = Eigen::Vector3d::UnitY();
    if (std::abs(axis.z()) < std::abs(axis.x()) && std::abs(axis.z()) < std::abs(axis.y()))
      least_aligned = Eigen::Vector3d::UnitZ();
    u = unit3(cross3(least_aligned, axis));
    v = cross3(axis, u);
  }
  Eigen::Vector3d u, v;
};

}  // namespace pcl_bv::detail
