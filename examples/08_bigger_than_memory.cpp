// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Fits volumes to a file that may be larger than memory. The points are read in blocks, and a fit may read
// the file several times.
#include <pcl_bv/fitting/fit.h>
#include <pcl_bv/io/cloud_file.h>

#include <filesystem>
#include <fstream>
#include <iostream>

int main(int argc, char** argv) {
  const std::filesystem::path path = argc > 1 ? argv[1] : "/tmp/pcl_bv_example_grid.bin";
  if (argc == 1) {  // no file given: write 100 000 points, each with x, y, z, intensity
    std::ofstream grid(path, std::ios::binary);
    for (int i = 0; i < 100'000; ++i) {
      const float point[4] = {0.1F * static_cast<float>(i % 100), 0.1F * static_cast<float>(i / 100), 1, 0};
      grid.write(reinterpret_cast<const char*>(point), sizeof point);
    }
  }
  const auto file = pcl_bv::CloudFile::open(path);  // null for files that cannot be read in blocks
  if (file == nullptr) return 1;
  const auto box = pcl_bv::fit_aabb(file->xyz(), pcl_bv::Threads{0});
  const auto sphere = pcl_bv::fit_sphere(file->xyz());
  std::cout << box.used << " points, box of " << box->volume() << " m3, radius " << sphere->radius() << "\n";
  return box.used > 0 ? 0 : 1;
}
