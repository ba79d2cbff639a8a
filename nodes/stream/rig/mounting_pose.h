// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <optional>
#include <vector>

#include "pcl_bv/nodes/frame.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Returns the pose with this position, metres, and the rotations about the fixed axes x, y and z, in this
/// order, radians, as in URDF.
Pose pose_of_angles(const Eigen::Vector3d& position, const Eigen::Vector3d& roll_pitch_yaw);

/// Returns the pose with this position and rotation. Returns nullopt if a number is not finite, exceeds
/// kMaxCoordinate, or if the squared length of the quaternion is not 1 to within 1e-2: a transform with a
/// scale is not a pose.
std::optional<Pose> pose_of_quaternion(const Eigen::Vector3d& position, const Eigen::Quaterniond& rotation);

/// Returns the pose of RigSensor::pose, or nullopt if the numbers are not a pose.
std::optional<Pose> mounting_pose(const std::vector<double>& numbers);

}  // namespace detail
}  // namespace pcl_bv
