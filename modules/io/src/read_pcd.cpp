// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Nothing is allocated for points before the header's sizes have been held against the size of the file.
#include <algorithm>
#include <bit>
#include <new>

#include "input_file.h"
#include "pcd_ascii.h"
#include "pcd_compressed.h"
#include "pcd_header.h"
#include "pcl_bv/io/pcd.h"
#include "pcl_bv/io/raw_cloud_edit.h"

namespace pcl_bv {
namespace {

static_assert(std::endian::native == std::endian::little, "records are used as they are in the file");

void read_binary_points(const InputFile& file, std::size_t offset, RawCloud& cloud) {
  const std::size_t needed = cloud.size() * cloud.point_step;
  const std::size_t available = file.size() - offset;
  if (needed > available) {
    throw IoError("truncated: " + std::to_string(cloud.size()) + " points of " +
                  std::to_string(cloud.point_step) + " bytes need " + std::to_string(needed) +
                  " bytes, the file has " + std::to_string(available));
  }
  cloud.data.resize(needed);
  file.read(offset, cloud.data.data(), needed);
}

RawCloud read_points(const InputFile& file) {
  std::string start(std::min(file.size(), max_pcd_header_size), '\0');
  file.read(0, start.data(), start.size());
  PcdHeader header = parse_pcd_header(start);
  switch (header.encoding) {
    case PcdEncoding::ascii:
      read_ascii_points(file, header.data_offset, header.cloud);
      break;
    case PcdEncoding::binary:
      read_binary_points(file, header.data_offset, header.cloud);
      break;
    case PcdEncoding::binary_compressed:
      read_compressed_points(file, header.data_offset, header.cloud);
      break;
  }
  update_packed_xyz(header.cloud);
  return std::move(header.cloud);
}

}  // namespace

RawCloud read_pcd(const std::filesystem::path& path) {
  const InputFile file(path);
  try {
    return read_points(file);
  } catch (const std::bad_alloc&) {
    throw not_enough_memory(file);
  }
}

}  // namespace pcl_bv
