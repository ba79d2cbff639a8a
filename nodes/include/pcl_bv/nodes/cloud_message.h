// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "pcl_bv/messages/types.h"
#include "pcl_bv/nodes/frame.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// A serialised message and the owner of its bytes.
struct CloudMessage {
  const std::byte* data = nullptr;
  std::size_t size = 0;
  std::shared_ptr<const void> owner;
  bool ros1 = false;  ///< Whether `data` has ROS 1 encoding. Otherwise: CDR with its encapsulation header.
};

/// Parses a sensor_msgs/msg/PointCloud2. The result refers to the point data in the bytes of `message` and
/// does not copy them. Throws MessageError if the message is not a PointCloud2.
msg::PointCloud2 cloud_in(const CloudMessage& message);

/// Turns a sensor_msgs/msg/PointCloud2 into a frame.
///
/// Sets points, intensity, owner and frame_id. Sets the stamp unless that of the message is 0. Sets `note` to
/// the names of fields that cannot be read (skipped_fields_note()). Points are not copied if they can be read
/// in place (view_points()). If `class_field` is not empty, Frame::classes gets the values of that integer
/// field. Throws MessageError if the message is not a PointCloud2, and std::runtime_error if the class field
/// cannot be used (integers_of()).
void read_cloud_message(const CloudMessage& message, const std::string& class_field, Frame& frame);

/// As the function above, for a parsed message; `owner` keeps its data alive.
void read_cloud_message(const msg::PointCloud2& cloud, const std::shared_ptr<const void>& owner,
                        const std::string& class_field, Frame& frame);

}  // namespace pcl_bv
