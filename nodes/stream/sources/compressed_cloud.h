// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <memory>

#include "pcl_bv/messages/compressed_cloud.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// A cloud and the owner of its data.
struct DecompressedCloud {
  msg::PointCloud2 cloud;
  std::shared_ptr<const void> owner;
};

/// Decompresses a cloud of the formats zlib, zstd and draco. The result has at most as many bytes as the
/// message announces by its width, height, point_step and row_step. Loads the module `draco` for the first
/// cloud of this format.
///
/// Throws MessageError for another format, if the data is damaged, if the data becomes longer than announced,
/// if the message announces more than 512 MiB, if the module `draco` is needed but not
/// installed, or in builds without the component `recording`.
DecompressedCloud decompress(const msg::CompressedPointCloud2& message);

}  // namespace detail
}  // namespace pcl_bv
