// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <draco/point_cloud/point_cloud.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_bv::draco_module {

/// Limits that the data must keep. They are checked before Draco allocates memory for points.
struct CloudLimits {
  std::uint32_t max_points = 0;
  std::vector<std::size_t> attribute_bytes;  ///< Bytes of each attribute of a point.
};

/// Decodes a point cloud of Draco's bitstream 2.3 or later with one of its two encodings of point clouds.
/// Throws MessageError if the data is damaged or exceeds the limits. The attributes of the result are those
/// of CloudLimits, in their order.
void decode_cloud(const std::byte* data, std::size_t size, const CloudLimits& limits,
                  draco::PointCloud& cloud);

}  // namespace pcl_bv::draco_module
