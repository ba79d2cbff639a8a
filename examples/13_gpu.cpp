// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Fits volumes to a cloud in the memory of a graphics card: around all points, and around clusters of them.
// Then finds the points nearest to two positions, by a search tree on the card.
#include <pcl_bv/gpu/gpu_fit.h>
#include <pcl_bv/gpu/gpu_tree.h>

#include <array>
#include <cmath>
#include <iostream>

int main() {
  std::vector<std::array<float, 3>> points;
  for (int i = 0; i < 100000; ++i) {  // a ball at x = 0 and one at x = 20
    const auto t = static_cast<float>(i % 50000);
    points.push_back({std::sin(t) * std::cos(3 * t) + (i < 50000 ? 0.0F : 20.0F),
                      std::sin(t) * std::sin(3 * t), std::cos(t)});
  }

  try {
    for (const pcl_bv::GpuInfo& device : pcl_bv::gpu_devices())
      std::cout << device.number << ' ' << device.name << '\n';

    const pcl_bv::GpuDevice device("0");  // "auto" takes the best card, and no software driver
    const pcl_bv::GpuCloud cloud(device, pcl_bv::view(points));
    const std::vector<const pcl_bv::Method*> methods = {pcl_bv::find_method("aabb"),
                                                        pcl_bv::find_method("dop26")};
    for (const pcl_bv::Fitted<pcl_bv::AnyVolume>& fitted : pcl_bv::fit(cloud, methods))
      std::cout << pcl_bv::shape_name(fitted.volume) << "  " << pcl_bv::volume(fitted.volume) << " m3\n";

    // Cluster i has the points offsets[i] to offsets[i + 1] - 1.
    const pcl_bv::ClusterFits balls = pcl_bv::fit(cloud, std::vector<std::size_t>{0, 50000, 100000}, methods);
    for (std::size_t i = 0; i < balls.size(); ++i)
      std::cout << "ball " << i << "  " << pcl_bv::volume(balls.fitted(i, 1).volume) << " m3\n";

    const pcl_bv::GpuTree tree(cloud);
    const std::vector<std::array<float, 3>> positions = {{5, 0, 0}, {15, 0, 0}};
    std::vector<pcl_bv::Neighbor> found;
    pcl_bv::nearest(tree, pcl_bv::view(positions), found);
    for (const pcl_bv::Neighbor& neighbor : found)
      std::cout << "point " << neighbor.index << " at " << std::sqrt(neighbor.squared_distance) << " m\n";
    return balls.size() == 2 && found.size() == 2 ? 0 : 1;
  } catch (const pcl_bv::GpuError& error) {
    std::cout << error.what() << '\n';  // a machine without a device
    return 0;
  }
}
