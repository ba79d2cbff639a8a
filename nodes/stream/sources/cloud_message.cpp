// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cloud_message.h"

#include <utility>

#include "compressed_cloud.h"
#include "pcl_bv/io/raw_cloud_edit.h"
#include "pcl_bv/messages/cloud.h"
#include "pcl_bv/messages/livox.h"
#include "pcl_bv/messages/serialize.h"

namespace pcl_bv {
using namespace detail;
namespace {

constexpr std::pair<const char*, CloudType> kCloudTypes[]{
    {msg::PointCloud2::ros_type, CloudType::point_cloud2},
    {msg::CustomMsg::ros_type, CloudType::livox},
    {msg::CustomMsg::old_ros_type, CloudType::livox},
    {msg::CompressedPointCloud2::ros_type, CloudType::compressed},
    {msg::DracoPointCloud2::ros_type, CloudType::compressed_draco},
};

template <class Cloud>
Cloud parse(const CloudMessage& message) {
  return read_message<Cloud>(message.data, message.size, message.ros1);
}

DecompressedCloud decompressed(const CloudMessage& message) {
  if (message.type == CloudType::compressed_draco) return decompress(parse<msg::DracoPointCloud2>(message));
  return decompress(parse<msg::CompressedPointCloud2>(message));
}

// Turns a parsed cloud into a frame. `owner` keeps the data of the cloud alive.
template <class Cloud>
void read_parsed(const Cloud& cloud, const std::shared_ptr<const void>& owner, const std::string& class_field,
                 Frame& frame) {
  frame.header.frame_id = cloud.header.frame_id;
  frame.header.stamp_ns = msg::nanoseconds_of(cloud.header.stamp);
  const std::optional<PointView> in_place = view_points(cloud);
  if (in_place) {
    frame.points = *in_place;
    frame.intensity = view_intensity(cloud);
    frame.times = view_times(cloud);
    frame.owner = owner;
    frame.note = skipped_fields_note(cloud);
  }
  const bool wants_classes = !class_field.empty();
  if (wants_classes && in_place && in_place->empty()) {
    frame.classes = std::make_shared<std::vector<std::int64_t>>();
    return;
  }
  if (in_place && !wants_classes) return;
  const auto copy = std::make_shared<RawCloud>(raw_cloud_of(cloud));
  if (wants_classes)
    frame.classes = std::make_shared<std::vector<std::int64_t>>(integers_of(*copy, class_field));
  if (!in_place) {
    frame.points = copy->xyz();
    frame.intensity = intensity_of(copy->fields, copy->data.data(), copy->point_step);
    frame.times = times_of(copy->fields, copy->data.data(), copy->point_step);
    frame.note = copy->note;
    frame.owner = copy;
  }
}

}  // namespace

std::optional<CloudType> detail::cloud_type_of(std::string_view ros_type) {
  for (const auto& [name, type] : kCloudTypes)
    if (ros_type == name) return type;
  return std::nullopt;
}

const std::vector<std::string>& detail::cloud_type_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto& [name, type] : kCloudTypes)
      all.emplace_back(name);
    return all;
  }();
  return names;
}

RawCloud detail::raw_cloud_in(const CloudMessage& message) {
  if (message.type == CloudType::livox) return raw_cloud_of(parse<msg::CustomMsg>(message));
  if (message.type == CloudType::point_cloud2) return raw_cloud_of(cloud_in(message));
  return raw_cloud_of(decompressed(message).cloud);
}

msg::PointCloud2 cloud_in(const CloudMessage& message) {
  return parse<msg::PointCloud2>(message);
}

void read_cloud_message(const CloudMessage& message, const std::string& class_field, Frame& frame) {
  if (message.type == CloudType::livox)
    return read_parsed(parse<msg::CustomMsg>(message), message.owner, class_field, frame);
  if (message.type == CloudType::point_cloud2)
    return read_cloud_message(cloud_in(message), message.owner, class_field, frame);
  const DecompressedCloud made = decompressed(message);
  read_cloud_message(made.cloud, made.owner, class_field, frame);
}

void read_cloud_message(const msg::PointCloud2& cloud, const std::shared_ptr<const void>& owner,
                        const std::string& class_field, Frame& frame) {
  read_parsed(cloud, owner, class_field, frame);
}

}  // namespace pcl_bv
