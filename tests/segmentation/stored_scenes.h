// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Scenes with clusters that lie in many bricks or shares, and the bytes of their clusters.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "clouds.h"
#include "pcl_bv/segmentation/stored_clusters.h"

namespace pcl_bv::detail {

// The points of each cluster, as bytes.
using ClusterBytes = std::vector<std::vector<std::byte>>;

inline void append_bytes(const PointView& points, std::vector<std::byte>& to) {
  const std::size_t size = size_of(points.scalar);
  for (std::size_t i = 0; i < points.count; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::byte* const at = points.address(i) + axis * points.step();
      to.insert(to.end(), at, at + size);
    }
  }
}

inline ClusterBytes bytes_of(const StoredClusters& clusters) {
  ClusterBytes all(clusters.size());
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    const StoredClusters::Points points = clusters.points(c);
    EXPECT_EQ(points.view().count, clusters.point_count(c));
    for (std::size_t first = 0; first < points.view().count; first += kChunkPoints) {
      const LoadedPoints part(points.view(), first, std::min(kChunkPoints, points.view().count - first));
      append_bytes(part.view(), all[c]);
    }
  }
  return all;
}

inline ClusterBytes bytes_of(const PointView& points, const Clusters& clusters) {
  ClusterBytes all(clusters.size());
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    PointView part = points;
    part.indices = clusters.list(c);
    part.count = clusters.list_size(c);
    append_bytes(part, all[c]);
  }
  return all;
}

// Lines, sheets and clumps that cross many bricks, with noise between them.
template <typename T>
test::TestCloud<T> scene(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  test::TestCloud<T> cloud{"seed " + std::to_string(seed), {}};
  const auto add = [&](double x, double y, double z) {
    cloud.xyz.insert(cloud.xyz.end(), {static_cast<T>(x), static_cast<T>(y), static_cast<T>(z)});
  };
  const double extent = std::pow(10, uniform(1, 2.5));
  for (int object = 0; object < 25; ++object) {
    const double x = uniform(-extent, extent), y = uniform(-extent, extent), z = uniform(0, 3);
    const double length = uniform(0, object % 3 == 0 ? extent : 3), angle = uniform(0, 6.28);
    const int count = static_cast<int>(uniform(1, object % 3 == 0 ? 600 : 60));
    for (int i = 0; i < count; ++i) {
      const double along = uniform(0, length), spread = object % 5 == 0 ? 2 : 0.2;
      add(x + along * std::cos(angle) + uniform(-spread, spread),
          y + along * std::sin(angle) + uniform(-0.2, 0.2), z + uniform(-0.1, 0.1));
    }
  }
  for (int i = 0; i < 300; ++i)
    add(uniform(-extent, extent), uniform(-extent, extent), uniform(0, 5));
  std::vector<std::size_t> order(cloud.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = i;
  if (seed % 2 == 0) std::shuffle(order.begin(), order.end(), random);
  test::TestCloud<T> mixed{cloud.name, {}};
  for (const std::size_t i : order)
    mixed.xyz.insert(mixed.xyz.end(), cloud.xyz.begin() + static_cast<std::ptrdiff_t>(3 * i),
                     cloud.xyz.begin() + static_cast<std::ptrdiff_t>(3 * i + 3));
  if (seed % 3 == 0) mixed.xyz[3 * (seed % mixed.size())] = std::numeric_limits<T>::quiet_NaN();
  return mixed;
}

inline ClusterOptions random_options(std::mt19937_64& random) {
  ClusterOptions options;
  options.tolerance =
      static_cast<float>(std::pow(10, std::uniform_real_distribution<double>(-1.2, 0.5)(random)));
  options.min_size = random() % 2 == 0 ? 1 : 10;
  options.min_points = std::array{1, 2, 4, 8}[random() % 4];
  if (random() % 4 == 0) options.max_size = 300;
  if (random() % 4 == 0) options.oversized = Oversized::keep;
  return options;
}

// Calls check(points, options) for nasty clouds with tolerances from very small to very large, until a check
// fails.
template <typename T, typename Check>
void for_each_nasty_clustering(const Check& check) {
  for (const test::TestCloud<T>& cloud : test::nasty_clouds<T>()) {
    SCOPED_TRACE(cloud.name);
    for (const float tolerance : {1e-20F, 1e-3F, 0.5F, 1e4F, 1e20F}) {
      for (const std::size_t min_points : {1, 3}) {
        ClusterOptions options;
        options.tolerance = tolerance;
        options.min_points = min_points;
        check(cloud.view(), options);
      }
    }
    if (testing::Test::HasFailure()) return;
  }
}

}  // namespace pcl_bv::detail
