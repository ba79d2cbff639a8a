// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The example of README.md, compiled and run as it stands there (CMakeLists.txt cuts it out).
#include <pcl/point_types.h>
// clang-format off
#include "readme_includes.inc"
// clang-format on

#include <iostream>

int main() {
  pcl::PointCloud<pcl::PointXYZI>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZI>);
  for (int i = 0; i < 100; ++i) {
    pcl::PointXYZI p;
    p.x = i < 50 ? 0.0F : 20.0F;
    p.y = 0.1F * static_cast<float>(i % 50);
    p.z = 0.3F * static_cast<float>(i % 2);
    cloud->push_back(p);
  }
#include "readme_example.inc"
  return kdops.size() == 2 ? 0 : 1;
}
