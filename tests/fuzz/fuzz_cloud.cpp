// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cstdint>

#include "pcl_bv/messages/cloud.h"
#include "pcl_bv/messages/livox.h"
#include "pcl_bv/messages/serialize.h"

namespace pcl_bv::detail {
namespace {

// A view and a copy agree to the bit.
template <class Cloud>
void look(const Cloud& cloud) {
  const std::optional<PointView> view = view_points(cloud);
  const RawCloud copy = raw_cloud_of(cloud);
  if (!view || view->count == 0) return;
  const PointView all = copy.xyz();
  if (all.count != view->count || all.scalar != view->scalar) __builtin_trap();
  for (std::size_t i = 0; i < all.count; ++i) {
    if (std::memcmp(all.address(i), view->address(i), 3 * size_of(all.scalar)) != 0) __builtin_trap();
  }
}

template <class Cloud>
void look_at_both_encodings(const std::byte* bytes, std::size_t size) {
  for (const bool ros1 : {false, true}) {
    try {
      look(read_message<Cloud>(bytes, size, ros1));
    } catch (const MessageError&) {
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail

// Any bytes as sensor_msgs/PointCloud2 and as the clouds of Livox' drivers, of ROS 2 and of ROS 1.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pcl_bv;
  const auto* const bytes = reinterpret_cast<const std::byte*>(data);
  detail::look_at_both_encodings<msg::PointCloud2>(bytes, size);
  detail::look_at_both_encodings<msg::CustomMsg>(bytes, size);
  return 0;
}
