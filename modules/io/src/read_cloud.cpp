// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/io/read_cloud.h"

#include "pcl_bv/io/kitti_bin.h"
#include "pcl_bv/io/pcd.h"
#include "pcl_bv/io/ply.h"

namespace pcl_bv {

std::string lower_case_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension)
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return extension;
}

bool is_cloud_name(const std::filesystem::path& path) {
  const std::string extension = lower_case_extension(path);
  return extension == ".pcd" || extension == ".ply" || extension == ".bin";
}

RawCloud read_cloud(const std::filesystem::path& path, const ParallelPolicy& policy) {
  const std::string extension = lower_case_extension(path);
  if (extension == ".ply") return read_ply(path, policy);
  if (extension == ".bin") return read_kitti_bin(path);
  return read_pcd(path, policy);
}

}  // namespace pcl_bv
