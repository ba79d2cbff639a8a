// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The compressed clouds of point_cloud_transport. types.h describes each_field().
#pragma once

#include "pcl_bv/messages/types.h"

namespace [[gnu::visibility("default")]] pcl_bv {
namespace msg {

/// point_cloud_interfaces/msg/CompressedPointCloud2. All fields but the data and `format` are those of
/// the PointCloud2 that was compressed.
struct CompressedPointCloud2 {
  static constexpr const char* ros_type = "point_cloud_interfaces/msg/CompressedPointCloud2";
  Header header;
  std::uint32_t height = 1, width = 0;
  std::vector<PointField> fields;
  bool is_bigendian = false;
  std::uint32_t point_step = 0, row_step = 0;
  Bytes compressed_data;
  bool is_dense = false;
  std::string format;  ///< The plugin that compressed the cloud, such as "zlib".
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.header, m.height, m.width, m.fields, m.is_bigendian, m.point_step, m.row_step, m.compressed_data,
          m.is_dense, m.format);
  }
};

/// draco_point_cloud_transport/CompressedPointCloud2 of ROS 1, which has no field `format`.
struct DracoPointCloud2 : CompressedPointCloud2 {
  static constexpr const char* ros_type = "draco_point_cloud_transport/msg/CompressedPointCloud2";
  DracoPointCloud2() { format = "draco"; }
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.header, m.height, m.width, m.fields, m.is_bigendian, m.point_step, m.row_step, m.compressed_data,
          m.is_dense);
  }
};

}  // namespace msg
}  // namespace pcl_bv
