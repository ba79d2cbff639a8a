// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <new>

#include "binary_points.h"
#include "input_file.h"
#include "pcl_bv/io/kitti_bin.h"

namespace pcl_bv {

RawCloud read_kitti_bin(const std::filesystem::path& path) {
  const InputFile file(path);
  try {
    return read_points(file, find_kitti_points(file));
  } catch (const std::bad_alloc&) {
    throw not_enough_memory(file);
  }
}

}  // namespace pcl_bv
