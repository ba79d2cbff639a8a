// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Finds clusters and boxes of points of your own type, without PCL and without copying the points.
#include <pcl_bv/core.h>

#include <iostream>
#include <vector>

struct Return {  // a point as the driver of a sensor delivers it
  double time;
  double x, y, z;
  unsigned char ring, intensity;
};

int main() {
  std::vector<Eigen::Vector3f> sweep;
  for (int i = 0; i < 400; ++i)  // two objects, 8 m apart
    sweep.emplace_back(i < 250 ? 0.0F : 8.0F, 0.05F * static_cast<float>(i % 50), 0.2F * static_cast<float>(i % 7));

  const auto points = pcl_bv::view(sweep);                    // refers to the sweep, copies nothing
  const auto clusters = pcl_bv::cluster(points, {0.5F, 30});  // tolerance in metres, smallest number of points
  for (const auto& box : pcl_bv::fit_obb(points, clusters))
    std::cout << box->center().transpose() << "  " << box->volume() << " m3\n";

  std::vector<Return> returns;
  for (const Eigen::Vector3f& p : sweep) returns.push_back({0.1, 5e6 + p.x(), 4e5 + p.y(), p.z(), 0, 0});
  const pcl_bv::PointView own = pcl_bv::view(returns);
  const pcl_bv::Clusters objects = pcl_bv::cluster(own, {1.0F, 10}, pcl_bv::Threads{2});
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const pcl_bv::PointView object = own.subset(objects.list(i), objects.list_size(i));
    const pcl_bv::Fitted<pcl_bv::Aabb> box = pcl_bv::fit_aabb(object);
    std::cout << box.used << " points from " << box->min().transpose() << " to " << box->max().transpose() << "\n";
  }
  return clusters.size() == 2 && objects.size() == 2 && objects.list_size(0) == 250 ? 0 : 1;
}
