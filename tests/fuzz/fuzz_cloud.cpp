// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cstdint>

#include "pcl_bv/messages/cloud.h"
#include "pcl_bv/messages/serialize.h"

namespace pcl_bv::detail {
namespace {

// A view and a copy agree to the bit.
void look(const msg::PointCloud2& cloud) {
  const std::optional<PointView> view = view_points(cloud);
  const RawCloud copy = raw_cloud_of(cloud);
  if (!view || view->count == 0) return;
  const PointView all = copy.xyz();
  if (all.count != view->count || all.scalar != view->scalar) __builtin_trap();
  for (std::size_t i = 0; i < all.count; ++i) {
    if (std::memcmp(all.address(i), view->address(i), 3 * size_of(all.scalar)) != 0) __builtin_trap();
  }
}

}  // namespace
}  // namespace pcl_bv::detail

// Any bytes as sensor_msgs/PointCloud2 of ROS 2 and of ROS 1.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pcl_bv;
  using namespace pcl_bv::detail;
  const auto* const bytes = reinterpret_cast<const std::byte*>(data);
  for (const bool ros1 : {false, true}) {
    try {
      msg::PointCloud2 cloud;
      if (ros1) {
        read_ros1(bytes, size, cloud);
      } else {
        read_cdr(bytes, size, cloud);
      }
      look(cloud);
    } catch (const MessageError&) {
    }
  }
  return 0;
}
