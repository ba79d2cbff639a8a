// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The interface of the module `draco`, which is loaded for the first cloud that Draco has compressed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pcl_bv/messages/compressed_cloud.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Records of `point_step` bytes with the fields of a message. Draco may have changed the order of the points
/// and removed duplicates.
struct DracoPoints {
  std::uint32_t count = 0;
  std::vector<std::byte> data;
};

/// Decodes the data of a message of the format draco. Throws MessageError if the data is damaged, if its
/// attributes are not the fields of the message, or if there are more than `max_points` points.
using DecodeDraco = void (*)(const msg::CompressedPointCloud2& message, std::uint32_t max_points,
                             DracoPoints& points);

/// Function that the module exports as `extern "C"`.
inline constexpr const char* kDecodeDraco = "pcl_bv_decode_draco";

}  // namespace detail
}  // namespace pcl_bv
