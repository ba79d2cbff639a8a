// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The exported functions of the module `draco`. draco_point_cloud_transport makes one attribute of each
// field, in the order of the fields.

#include <algorithm>
#include <array>
#include <string>

#include "cloud_decoder.h"
#include "pcl_bv/messages/serialize.h"
#include "stream/sources/draco_module.h"

namespace pcl_bv::draco_module {
namespace {

using detail::DracoPoints;

// Sizes of the datatypes of sensor_msgs/PointField; 0 for unknown ones.
std::size_t datatype_bytes(std::uint8_t datatype) {
  constexpr std::array<std::size_t, 9> bytes{0, 1, 1, 2, 2, 4, 4, 4, 8};
  return datatype < bytes.size() ? bytes[datatype] : 0;
}

// Returns the sizes of the fields. Throws MessageError for a field that is not within the record. Fields may
// overlap, but no more than that twice the record is needed, so that the memory is limited.
std::vector<std::size_t> field_bytes(const msg::CompressedPointCloud2& message) {
  std::vector<std::size_t> all;
  std::size_t sum = 0;
  for (const msg::PointField& field : message.fields) {
    const std::size_t bytes = datatype_bytes(field.datatype) * std::max(field.count, 1U);
    sum += bytes;
    if (bytes == 0 || std::uint64_t{field.offset} + bytes > message.point_step ||
        sum > 2 * std::size_t{message.point_step})
      throw MessageError("the cloud of Draco has a field that exceeds the record of " +
                         std::to_string(message.point_step) + " bytes");
    all.push_back(bytes);
  }
  return all;
}

void decode(const msg::CompressedPointCloud2& message, std::uint32_t max_points, DracoPoints& points) {
  const CloudLimits limits{max_points, field_bytes(message)};
  draco::PointCloud cloud;
  decode_cloud(message.compressed_data.data, message.compressed_data.size, limits, cloud);
  points.count = cloud.num_points();
  points.data.assign(std::size_t{points.count} * message.point_step, std::byte{0});
  for (std::size_t i = 0; i < message.fields.size(); ++i) {
    const draco::PointAttribute& attribute = *cloud.attribute(static_cast<int>(i));
    std::byte* to = points.data.data() + message.fields[i].offset;
    for (std::uint32_t point = 0; point < points.count; ++point, to += message.point_step) {
      const draco::AttributeValueIndex value = attribute.mapped_index(draco::PointIndex(point));
      if (value.value() >= attribute.size()) throw MessageError("the cloud of Draco lacks values of a field");
      attribute.GetValue(value, to);
    }
  }
}

}  // namespace
}  // namespace pcl_bv::draco_module

extern "C" [[gnu::visibility("default")]] const char* pcl_bv_module_version() {
  return PCL_BV_VERSION;
}

extern "C" [[gnu::visibility("default")]] void pcl_bv_decode_draco(
    const pcl_bv::msg::CompressedPointCloud2& message, std::uint32_t max_points,
    pcl_bv::detail::DracoPoints& points) {
  pcl_bv::draco_module::decode(message, max_points, points);
}
