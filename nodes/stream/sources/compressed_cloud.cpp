// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "compressed_cloud.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "draco_module.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/messages/serialize.h"
#include "pcl_bv/recording/decompress.h"
#include "stream/middleware.h"

namespace pcl_bv::detail {
namespace {

constexpr std::uint64_t kMaxCloudBytes = std::uint64_t{512} << 20U;

// Returns the number of bytes that the message announces. Some drivers write the height 0 or a wrong
// row_step, which is no error if the data fits the points (view_points()), so that the larger number counts.
std::size_t announced_bytes(const msg::CompressedPointCloud2& message) {
  const std::uint64_t packed = std::uint64_t{message.width} * message.point_step;
  const std::uint64_t row = std::max<std::uint64_t>(packed, message.row_step);
  const std::uint64_t rows = std::max(message.height, 1U);
  if (row > kMaxCloudBytes / rows)
    throw MessageError("the compressed cloud announces " + std::to_string(message.height) + " rows of " +
                       std::to_string(row) + " bytes; 512 MiB are allowed");
  return static_cast<std::size_t>(row * rows);
}

// Returns the largest number of points that Draco may decode. The number of compressed bytes limits it, too,
// because a few bytes could announce any number. Clouds of LiDARs have less than a million points, and more
// than a byte for each of them.
std::uint32_t max_draco_points(const msg::CompressedPointCloud2& message) {
  const std::uint64_t announced = std::uint64_t{message.width} * std::max(message.height, 1U);
  const std::uint64_t plausible =
      (std::uint64_t{1} << 22U) + 256 * std::uint64_t{message.compressed_data.size};
  return static_cast<std::uint32_t>(
      std::min<std::uint64_t>({announced, plausible, std::numeric_limits<std::uint32_t>::max()}));
}

std::vector<std::byte> decompress_draco(const msg::CompressedPointCloud2& message, msg::PointCloud2& cloud) {
  const auto decode = reinterpret_cast<DecodeDraco>(module_function("draco", kDecodeDraco));
  DracoPoints points;
  decode(message, max_draco_points(message), points);
  if (points.count != std::uint64_t{cloud.width} * cloud.height) {  // without duplicates, in one row
    cloud.width = points.count;
    cloud.height = 1;
  }
  cloud.row_step = cloud.width * cloud.point_step;  // padding of rows is not compressed
  return std::move(points.data);
}

std::vector<std::byte> decompress_data(const msg::CompressedPointCloud2& message, msg::PointCloud2& cloud) {
  const std::size_t limit = announced_bytes(message);
  const auto [data, size] = message.compressed_data;
  if (message.format == "zlib") return decompress_zlib(data, size, limit);
  if (message.format == "zstd") return decompress_zstd(data, size, limit);
  if (message.format == "draco") return decompress_draco(message, cloud);
  throw MessageError("the cloud is compressed as " + in_quotes(message.format) +
                     ", not as zlib, zstd or draco");
}

}  // namespace

DecompressedCloud decompress(const msg::CompressedPointCloud2& message) {
  DecompressedCloud made;
  made.cloud.header = message.header;
  made.cloud.height = message.height;
  made.cloud.width = message.width;
  made.cloud.fields = message.fields;
  made.cloud.is_bigendian = message.is_bigendian;
  made.cloud.point_step = message.point_step;
  made.cloud.row_step = message.row_step;
  made.cloud.is_dense = message.is_dense;
  const auto bytes = std::make_shared<std::vector<std::byte>>();
  try {
    *bytes = decompress_data(message, made.cloud);
  } catch (const IoError& error) {
    throw MessageError(std::string("the compressed cloud: ") + error.what());
  }
  made.cloud.data = {bytes->data(), bytes->size()};
  made.owner = bytes;
  return made;
}

}  // namespace pcl_bv::detail
