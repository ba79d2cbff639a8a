// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "pcl_bv/messages/types.h"
#include "pcl_bv/nodes/frame.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// The bytes of a message, and what keeps them there.
struct CloudMessage {
  const std::byte* data = nullptr;
  std::size_t size = 0;
  std::shared_ptr<const void> owner;
  bool ros1 = false;  ///< In ROS 1's encoding; else CDR with its encapsulation.
};

/// The message itself, whose data stay where they are. Throws MessageError for what is no
/// sensor_msgs/msg/PointCloud2.
msg::PointCloud2 cloud_in(const CloudMessage& message);

/// A sensor_msgs/msg/PointCloud2 as a frame: points, owner, frame_id, the stamp unless it is 0, and as `note`
/// which fields cannot be read (unread_fields()). The points stay where they lie if they can be viewed there
/// (points_in_place()), else they are copied. With `class_field` classes are that integer field. Throws
/// MessageError for what is no such cloud.
void read_cloud_message(const CloudMessage& message, const std::string& class_field, Frame& frame);

/// The same of a message that is read already; `owner` keeps its data.
void read_cloud_message(const msg::PointCloud2& cloud, const std::shared_ptr<const void>& owner,
                        const std::string& class_field, Frame& frame);

}  // namespace pcl_bv
