// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/nodes/cloud_message.h"

#include <utility>

#include "pcl_bv/io/raw_cloud_edit.h"
#include "pcl_bv/messages/cloud.h"
#include "pcl_bv/messages/serialize.h"

namespace pcl_bv {

void read_cloud_message(const CloudMessage& message, const std::string& class_field, Frame& frame) {
  msg::PointCloud2 cloud;
  if (message.ros1) {
    read_ros1(message.data, message.size, cloud);
  } else {
    read_cdr(message.data, message.size, cloud);
  }
  read_cloud_message(cloud, message.owner, class_field, frame);
}

void read_cloud_message(const msg::PointCloud2& cloud, const std::shared_ptr<const void>& owner,
                        const std::string& class_field, Frame& frame) {
  frame.header.frame_id = cloud.header.frame_id;
  if (const std::int64_t stamp = msg::nanoseconds_of(cloud.header.stamp); stamp != 0)
    frame.header.stamp_ns = stamp;
  const std::optional<PointView> in_place = points_in_place(cloud);
  if (in_place) {
    frame.points = *in_place;
    frame.intensity = intensity_in_place(cloud);
    frame.owner = owner;
  }
  if (in_place && class_field.empty()) return;
  const auto copy = std::make_shared<RawCloud>(raw_cloud_of(cloud));
  if (!class_field.empty())
    frame.classes = std::make_shared<std::vector<std::int64_t>>(integers_of(*copy, class_field));
  if (!in_place) {
    frame.points = copy->xyz();
    frame.intensity = intensity_of(copy->fields, copy->data.data(), copy->point_step);
    frame.owner = copy;
  }
}

}  // namespace pcl_bv
