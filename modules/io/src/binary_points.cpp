// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "binary_points.h"

#include <algorithm>
#include <bit>
#include <string>
#include <utility>

#include "pcd_header.h"
#include "pcl_bv/io/io_error.h"
#include "pcl_bv/io/raw_cloud_edit.h"
#include "pcl_bv/io/read_cloud.h"

namespace pcl_bv {

static_assert(std::endian::native == std::endian::little, "records are used as they are in the file");

std::optional<BinaryPoints> find_binary_points(const InputFile& file, const std::filesystem::path& path) {
  const std::string extension = lower_case_extension(path);
  if (extension == ".bin") return find_kitti_points(file);
  if (extension == ".ply") return std::nullopt;
  PcdHeader header = read_pcd_header(file);
  if (header.encoding != PcdEncoding::binary) return std::nullopt;
  require_points(file, header.data_offset, header.cloud);
  return BinaryPoints{std::move(header.cloud), header.data_offset};
}

BinaryPoints find_kitti_points(const InputFile& file) {
  BinaryPoints points;
  RawCloud& cloud = points.header;
  for (const char* name : {"x", "y", "z", "intensity"}) {
    cloud.fields.push_back({name, 'F', 4, 1, cloud.point_step});
    cloud.point_step += 4;
  }
  if (file.size() % cloud.point_step != 0) {
    throw IoError("truncated: " + std::to_string(file.size()) + " bytes are no multiple of the " +
                  std::to_string(cloud.point_step) + " of a point");
  }
  cloud.width = file.size() / cloud.point_step;
  return points;
}

void require_points(const InputFile& file, std::size_t offset, const RawCloud& header) {
  const std::size_t needed = header.size() * header.point_step;
  const std::size_t available = file.size() - offset;
  if (needed <= available) return;
  throw IoError("truncated: " + std::to_string(header.size()) + " points of " +
                std::to_string(header.point_step) + " bytes need " + std::to_string(needed) +
                " bytes, the file has " + std::to_string(available));
}

RawCloud read_points(const InputFile& file, BinaryPoints points) {
  RawCloud cloud = std::move(points.header);
  cloud.data.resize(cloud.size() * cloud.point_step);
  file.read(points.offset, cloud.data.data(), cloud.data.size());
  update_packed_xyz(cloud);
  return cloud;
}

}  // namespace pcl_bv
