// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A cloud of any point type, seeded.
#pragma once

#include <pcl/point_cloud.h>

#include <cstdint>
#include <random>

namespace pcl_bv {
using namespace detail;

template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr random_cloud(std::size_t points, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<float> normal(3, 2);
  typename pcl::PointCloud<PointT>::Ptr cloud(new pcl::PointCloud<PointT>);
  for (std::size_t i = 0; i < points; ++i) {
    PointT p;
    p.x = normal(random);
    p.y = normal(random);
    p.z = normal(random);
    cloud->push_back(p);
  }
  return cloud;
}

}  // namespace pcl_bv
