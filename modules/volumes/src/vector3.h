// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Written out, not left to Eigen, which fuses or vectorises as it is compiled: fits must give the same bits.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace pcl_bv::volumes_internal {

inline double dot(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return (a.x() * b.x() + a.y() * b.y()) + a.z() * b.z();
}

/// |v|_1, what error bounds are in terms of.
inline double taxicab(const Eigen::Vector3d& v) {
  return (std::abs(v.x()) + std::abs(v.y())) + std::abs(v.z());
}

}  // namespace pcl_bv::volumes_internal
