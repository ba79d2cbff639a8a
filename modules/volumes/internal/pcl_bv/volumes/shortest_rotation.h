// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Rotations that take one direction to another, for writers of volumes.
#pragma once

#include <Eigen/Geometry>

namespace pcl_bv::detail {

/// Returns the rotation with the smallest angle that takes a unit vector to another one. The angle must be at
/// most 90 degrees, for which this formula is well conditioned. Eigen's FromTwoVectors() takes any angle, but
/// its singular value decomposition took a third of the compile time of the sources that called it.
inline Eigen::Quaterniond shortest_rotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d axis = from.cross(to);
  return Eigen::Quaterniond(1 + from.dot(to), axis.x(), axis.y(), axis.z()).normalized();
}

}  // namespace pcl_bv::detail
