// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clouds for the tests of the ground, and a short way to split them.
#pragma once

#include <array>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

#include "pcl_bv/segmentation/ground_plane.h"

namespace pcl_bv {

template <typename T>
using Cloud = std::vector<std::array<T, 3>>;

template <typename T>
PointView view(const Cloud<T>& cloud) {
  return PointView::of(cloud.empty() ? nullptr : cloud[0].data(), sizeof(std::array<T, 3>), cloud.size());
}

template <typename T>
GroundSplit split(const Cloud<T>& cloud, const GroundPlaneSettings& settings = {}) {
  GroundSplit result;
  split_ground(view(cloud), settings, result);
  return result;
}

inline std::vector<std::int32_t> numbers(std::size_t begin, std::size_t end) {
  std::vector<std::int32_t> result(end - begin);
  std::iota(result.begin(), result.end(), static_cast<std::int32_t>(begin));
  return result;
}

/// `count` points on the rectangle of `half` metres around (x, y), at the heights slope * x + height + noise.
template <typename T>
void add_plane(Cloud<T>& cloud, std::size_t count, T half, T x, T y, T height, T slope = 0, T noise = 0) {
  std::mt19937 random(static_cast<std::uint32_t>(cloud.size() + count));
  std::uniform_real_distribution<T> uniform(-1, 1);
  for (std::size_t i = 0; i < count; ++i) {
    const T px = x + half * uniform(random);
    const T py = y + half * uniform(random);
    cloud.push_back({px, py, slope * px + height + noise * uniform(random)});
  }
}

}  // namespace pcl_bv
