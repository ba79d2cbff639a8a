// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "pcl_bv/kernels/deskew.h"
#include "pcl_bv/nodes/frame.h"

namespace pcl_bv::detail {

/// Returns the constant motion that moves the sensor from one pose to another in this time, above 0: the
/// logarithm of the rigid motion between them (Murray et al. 1994). The rotation between the poses must be
/// below pi.
inline SensorMotion motion_between(const Pose& before, const Pose& after, double seconds) {
  const Pose step = before.inverse() * after;
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(step.linear()));
  const Eigen::Vector3d rotation = turn.angle() * turn.axis();
  const double half = turn.angle() / 2;
  // (1 - half / tan(half)) / angle^2, which is 1/12 for small angles.
  const double factor = half < 1e-4 ? 1.0 / 12 : (1 - half / std::tan(half)) / (4 * half * half);
  const Eigen::Vector3d shift = step.translation(), across = rotation.cross(shift);
  const Eigen::Vector3d velocity = (shift - across / 2 + factor * rotation.cross(across)) / seconds;
  SensorMotion motion;
  for (int i = 0; i < 3; ++i) {
    motion.velocity[static_cast<std::size_t>(i)] = velocity[i];
    motion.angular_velocity[static_cast<std::size_t>(i)] = rotation[i] / seconds;
  }
  return motion;
}

}  // namespace pcl_bv::detail
