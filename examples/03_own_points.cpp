// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Finds clusters and boxes of points of your own type, without PCL and without copying the points.
#include <pcl_bv/fitting/fit.h>
#include <pcl_bv/segmentation/euclidean_clusters.h>

#include <iostream>
#include <vector>

struct Return {  // a point as the driver of a sensor delivers it
  double time;
  double x, y, z;
  unsigned char ring, intensity;
};

int main() {
  std::vector<Return> sweep;
  for (int i = 0; i < 400; ++i)
    sweep.push_back({0.001 * i, 5e6 + (i < 250 ? 0 : 8), 0.05 * (i % 50), 0.2 * (i % 7), 0, 0});

  const pcl_bv::PointView points = pcl_bv::PointView::of(&sweep[0].x, sizeof(Return), sweep.size());
  pcl_bv::Clusters clusters;
  pcl_bv::EuclideanClusterer().extract(points, {1.0F, 10}, clusters);
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    pcl_bv::PointView object = points;
    object.indices = clusters.cluster(i);
    object.count = clusters.cluster_size(i);
    pcl_bv::Aabb box;
    const pcl_bv::EstimationResult result = pcl_bv::fit_aabb(object, box, {pcl_bv::Threads{2}});
    std::cout << result.used << " points from " << box.min().transpose() << " to " << box.max().transpose() << "\n";
  }
  return clusters.size() == 2 && clusters.cluster_size(0) == 250 ? 0 : 1;
}
