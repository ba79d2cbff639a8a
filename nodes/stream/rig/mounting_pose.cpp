// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "mounting_pose.h"

#include <cmath>

namespace pcl_bv::detail {

Pose pose_of_angles(const Eigen::Vector3d& position, const Eigen::Vector3d& roll_pitch_yaw) {
  const Eigen::Quaterniond rotation = Eigen::AngleAxisd(roll_pitch_yaw.z(), Eigen::Vector3d::UnitZ()) *
                                      Eigen::AngleAxisd(roll_pitch_yaw.y(), Eigen::Vector3d::UnitY()) *
                                      Eigen::AngleAxisd(roll_pitch_yaw.x(), Eigen::Vector3d::UnitX());
  Pose pose = Pose::Identity();
  pose.linear() = rotation.toRotationMatrix();
  pose.translation() = position;
  return pose;
}

std::optional<Pose> pose_of_quaternion(const Eigen::Vector3d& position, const Eigen::Quaterniond& rotation) {
  constexpr double tolerance = 1e-2;
  // Comparisons with NaN are false.
  const bool is_pose =
      (position.array().abs() <= kMaxCoordinate).all() && std::abs(rotation.squaredNorm() - 1) <= tolerance;
  if (!is_pose) return std::nullopt;
  Pose pose = Pose::Identity();
  pose.linear() = rotation.normalized().toRotationMatrix();
  pose.translation() = position;
  return pose;
}

std::optional<Pose> mounting_pose(const std::vector<double>& n) {
  if (n.size() != 6 && n.size() != 7) return std::nullopt;
  for (const double number : n)
    if (!(std::abs(number) <= kMaxCoordinate)) return std::nullopt;
  const Eigen::Vector3d position(n[0], n[1], n[2]);
  if (n.size() == 6) return pose_of_angles(position, {n[3], n[4], n[5]});
  return pose_of_quaternion(position, Eigen::Quaterniond(n[6], n[3], n[4], n[5]));
}

}  // namespace pcl_bv::detail
