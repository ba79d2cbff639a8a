// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Scenes that are cut into shares.
#pragma once

#include <cmath>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "pcl_bv/segmentation/cluster_share.h"
#include "stored_scenes.h"

namespace pcl_bv::detail {

// Sorts the points of a cloud by tile, and returns where the tiles begin and end.
template <typename T>
std::vector<std::size_t> make_tiles(std::mt19937_64& random, test::TestCloud<T>& cloud) {
  const std::size_t tiles = 1 + random() % 8, kind = random() % 3;
  const double side = std::pow(10, std::uniform_real_distribution<double>(-0.5, 2)(random));
  std::vector<std::size_t> tile(cloud.size()), order(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double x = cloud.xyz[3 * i], y = cloud.xyz[3 * i + 1];
    const double square = std::isnan(x) ? 0 : std::floor(x / side) * 7 + std::floor(y / side) * 3;
    const std::size_t by_square = static_cast<std::size_t>(static_cast<std::int64_t>(square) + (1 << 20));
    tile[i] = (kind == 0 ? by_square : kind == 1 ? random() : i * tiles / cloud.size()) % tiles;
  }
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return tile[a] < tile[b]; });
  test::TestCloud<T> sorted{
      cloud.name + ", " + std::to_string(tiles) + " tiles of kind " + std::to_string(kind), {}};
  std::vector<std::size_t> ends{0};
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto from = cloud.xyz.begin() + static_cast<std::ptrdiff_t>(3 * order[i]);
    sorted.xyz.insert(sorted.xyz.end(), from, from + 3);
    if (i + 1 == order.size() || tile[order[i]] != tile[order[i + 1]]) ends.push_back(i + 1);
  }
  cloud = sorted;
  return ends;
}

using Shares = std::vector<std::unique_ptr<MadeClusterShare>>;

inline std::vector<const ClusterShare*> pointers(const Shares& shares) {
  std::vector<const ClusterShare*> all;
  for (const auto& share : shares)
    all.push_back(share.get());
  return all;
}

// Two clumps far apart, and a line of points across the border of the shares at x = 0.
inline test::TestCloud<float> two_clumps_and_a_line() {
  test::TestCloud<float> cloud{"clumps and line", {}};
  const auto add = [&](float x, float y) { cloud.xyz.insert(cloud.xyz.end(), {x, y, 0}); };
  for (int side : {-1, 1}) {
    for (int i = 0; i < 100; ++i)
      add(static_cast<float>(side * 100) + 0.01F * static_cast<float>(i), 0);
    for (int i = 0; i < 50; ++i)
      add(static_cast<float>(side) * (0.05F + 0.1F * static_cast<float>(i)), 0);
  }
  return cloud;
}

}  // namespace pcl_bv::detail
