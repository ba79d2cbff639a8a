// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Records of four floats and nothing else: the size of the file is the only thing that can be wrong.
#include <bit>
#include <new>
#include <string>

#include "input_file.h"
#include "pcl_bv/io/kitti_bin.h"

namespace pcl_bv {

static_assert(std::endian::native == std::endian::little, "records are used as they are in the file");

RawCloud read_kitti_bin(const std::filesystem::path& path) {
  const InputFile file(path);
  RawCloud cloud;
  for (const char* name : {"x", "y", "z", "intensity"}) {
    cloud.fields.push_back({name, 'F', 4, 1, cloud.point_step});
    cloud.point_step += 4;
  }
  if (file.size() % cloud.point_step != 0) {
    throw IoError("truncated: " + std::to_string(file.size()) + " bytes are no multiple of the " +
                  std::to_string(cloud.point_step) + " of a point");
  }
  cloud.width = file.size() / cloud.point_step;
  try {
    cloud.data.resize(file.size());
  } catch (const std::bad_alloc&) {
    throw not_enough_memory(file);
  }
  file.read(0, cloud.data.data(), cloud.data.size());
  return cloud;
}

}  // namespace pcl_bv
