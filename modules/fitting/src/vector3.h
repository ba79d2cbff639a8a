// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Sums of three in one stated order: Eigen's own may differ between processors.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace pcl_bv {

inline double dot3(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return (a.x() * b.x() + a.y() * b.y()) + a.z() * b.z();
}

inline double norm3(const Eigen::Vector3d& v) {
  return std::sqrt(dot3(v, v));
}

/// What one rounding to double is off by at most, relatively: the U of what is said about errors.
inline constexpr double kU = 0x1p-53;

/// |v|_1, what error bounds are in terms of.
inline double taxicab3(const Eigen::Vector3d& v) {
  return (std::abs(v.x()) + std::abs(v.y())) + std::abs(v.z());
}

inline Eigen::Vector3d cross3(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x()};
}

/// Of a vector of about unit length or more.
inline Eigen::Vector3d unit3(const Eigen::Vector3d& v) {
  return v / norm3(v);
}

/// Two unit vectors across a unit vector, right-handed with it.
struct Across {
  explicit Across(const Eigen::Vector3d& axis) {
    Eigen::Vector3d least = Eigen::Vector3d::UnitX();
    if (std::abs(axis.y()) < std::abs(axis.x())) least = Eigen::Vector3d::UnitY();
    if (std::abs(axis.z()) < std::abs(axis.x()) && std::abs(axis.z()) < std::abs(axis.y()))
      least = Eigen::Vector3d::UnitZ();
    u = unit3(cross3(least, axis));
    v = cross3(axis, u);
  }
  Eigen::Vector3d u, v;
};

}  // namespace pcl_bv
