// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cloud_sample.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace pcl_bv::detail {

void draw_sample(const PointView& points, std::uint32_t seed, std::size_t sample_size,
                 std::vector<Eigen::Vector3d>& sample) {
  sample.clear();
  sample.reserve(sample_size);
  const std::size_t n = points.count;
  if (n == 0) return;
  auto step = static_cast<std::size_t>(0.6180339887498949 * static_cast<double>(n));
  while (std::gcd(step, n) != 1)
    ++step;
  std::size_t i = seed % n;
  // Consecutive points of the sample are far apart in memory, so each batch is prefetched before its points
  // are read.
  std::array<std::size_t, 64> batch;
  for (std::size_t visited = 0; visited < n && sample.size() < sample_size; visited += batch.size()) {
    const std::size_t count = std::min({batch.size(), n - visited, sample_size - sample.size()});
    for (std::size_t k = 0; k < count; ++k) {
      batch[k] = i;
      __builtin_prefetch(points.address(i));
      i = i + step < n ? i + step : i + step - n;
    }
    for (std::size_t k = 0; k < count; ++k) {
      const Coordinates p = load_point(points, batch[k]);
      if (is_valid(p)) sample.push_back({p.x, p.y, p.z});
    }
  }
}

}  // namespace pcl_bv::detail
