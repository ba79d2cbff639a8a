// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What the tests of the clusterer share: clouds, and the definition of its result as an O(n^2) loop.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "pcl_bv/segmentation/clusters.h"

namespace pcl_bv::test {

template <typename T>
using Cloud = std::vector<std::array<T, 3>>;
using ClusterList = std::vector<std::vector<std::int32_t>>;

template <typename T>
PointView view_of(const Cloud<T>& cloud) {
  return PointView::of(cloud.empty() ? nullptr : cloud.front().data(), sizeof cloud[0], cloud.size());
}

inline ClusterList as_lists(const Clusters& clusters) {
  ClusterList lists;
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    lists.emplace_back(clusters.list(i), clusters.list(i) + clusters.list_size(i));
  }
  return lists;
}

template <typename T>
ClusterList cluster(const Cloud<T>& cloud, float tolerance) {
  Clusters clusters;
  EuclideanClusterer().extract(view_of(cloud), {tolerance}, clusters);
  return as_lists(clusters);
}

// volatile keeps each operation a single rounding to T, whatever the compiler is told.
template <typename T>
bool linked(const std::array<T, 3>& p, const std::array<T, 3>& q, float tolerance) {
  volatile T sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const volatile T difference = p[k] - q[k];
    const volatile T square = difference * difference;
    sum = sum + square;
  }
  return sum < static_cast<T>(static_cast<double>(tolerance) * static_cast<double>(tolerance));
}

/// Connected components by definition: largest first, then by smallest index.
template <typename T>
ClusterList brute_force(const Cloud<T>& cloud, float tolerance) {
  const auto finite = [](const std::array<T, 3>& p) {
    return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
  };
  ClusterList lists;
  std::vector<bool> seen(cloud.size());
  for (std::size_t seed = 0; seed < cloud.size(); ++seed) {
    if (seen[seed] || !finite(cloud[seed])) continue;
    std::vector<std::int32_t> queue{static_cast<std::int32_t>(seed)};
    seen[seed] = true;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      for (std::size_t j = 0; j < cloud.size(); ++j) {
        if (seen[j] || !finite(cloud[j]) || !linked(cloud[queue[i]], cloud[j], tolerance)) continue;
        seen[j] = true;
        queue.push_back(static_cast<std::int32_t>(j));
      }
    }
    std::sort(queue.begin(), queue.end());
    lists.push_back(std::move(queue));
  }
  std::stable_sort(lists.begin(), lists.end(),
                   [](const auto& a, const auto& b) { return a.size() > b.size(); });
  return lists;
}

template <typename T>
Cloud<T> uniform_cloud(std::size_t count, T half_side, unsigned seed, std::array<T, 3> center = {}) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<T> coordinate(-half_side, half_side);
  Cloud<T> cloud(count);
  for (auto& p : cloud) {
    for (std::size_t k = 0; k < 3; ++k)
      p[k] = center[k] + coordinate(random);
  }
  return cloud;
}

/// side^3 points, x fastest.
template <typename T>
Cloud<T> lattice(int side, T spacing, T origin = 0) {
  Cloud<T> cloud;
  for (int z = 0; z < side; ++z) {
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        cloud.push_back({origin + static_cast<T>(x) * spacing, origin + static_cast<T>(y) * spacing,
                         origin + static_cast<T>(z) * spacing});
      }
    }
  }
  return cloud;
}

}  // namespace pcl_bv::test
