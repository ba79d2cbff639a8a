// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The message of nav_msgs with the pose of a robot. types.h describes each_field().
#pragma once

#include "pcl_bv/messages/types.h"

namespace [[gnu::visibility("default")]] pcl_bv {
namespace msg {

/// geometry_msgs/msg/TwistWithCovariance.
struct TwistWithCovariance {
  Vector3 linear, angular;
  std::array<double, 36> covariance{};
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.linear, m.angular, m.covariance);
  }
};

/// nav_msgs/msg/Odometry: the pose of child_frame_id in header.frame_id.
struct Odometry {
  static constexpr const char* ros_type = "nav_msgs/msg/Odometry";
  Header header;
  std::string child_frame_id;
  PoseWithCovariance pose;
  TwistWithCovariance twist;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.header, m.child_frame_id, m.pose, m.twist);
  }
};

}  // namespace msg
}  // namespace pcl_bv
