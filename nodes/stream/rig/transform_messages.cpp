// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <optional>

#include "mounting_pose.h"
#include "pcl_bv/messages/odometry.h"
#include "pcl_bv/messages/serialize.h"
#include "transform_feed.h"

namespace pcl_bv::detail {
namespace {

std::optional<Pose> pose_of(const msg::Point& position, const msg::Quaternion& q) {
  return pose_of_quaternion({position.x, position.y, position.z}, {q.w, q.x, q.y, q.z});
}

}  // namespace

std::string add_transforms(const TransformMessage& bytes, Transforms& to) {
  std::string warning;
  // Without a topic of odometry in the settings, odometry is read only if nothing else gives its poses.
  const bool preferred = bytes.odometry;
  const auto add = [&](const msg::Header& header, const std::string& child, const std::optional<Pose>& pose) {
    if (!pose) {
      warning = "the transform from " + child + " to " + header.frame_id + " is not rigid; it is ignored";
    } else if (bytes.fixed) {
      to.add_fixed(header.frame_id, child, *pose);
    } else {
      to.add(header.frame_id, child, msg::nanoseconds_of(header.stamp), *pose, preferred);
    }
  };
  if (bytes.odometry) {
    const auto message = read_message<msg::Odometry>(bytes.data, bytes.size, bytes.ros1);
    const msg::Pose& pose = message.pose.pose;
    add(message.header, message.child_frame_id, pose_of(pose.position, pose.orientation));
  } else {
    const auto message = read_message<msg::TFMessage>(bytes.data, bytes.size, bytes.ros1);
    for (const msg::TransformStamped& step : message.transforms)
      add(step.header, step.child_frame_id, pose_of(step.transform.translation, step.transform.rotation));
  }
  return warning;
}

}  // namespace pcl_bv::detail
