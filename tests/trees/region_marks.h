// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Marks of regions, and what they should be.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "any_volumes.h"
#include "clouds.h"
#include "inflated.h"
#include "pcl_bv/trees/region_mask.h"

namespace pcl_bv::testing {
using namespace detail;

using Marks = std::vector<std::uint8_t>;

template <typename T>
test::TestCloud<T> cloud_of(const std::vector<Vector3d>& points) {
  test::TestCloud<T> cloud;
  for (const Vector3d& p : points) {
    for (const double c : p)
      cloud.xyz.push_back(static_cast<T>(c));
  }
  return cloud;
}

inline Marks marks(const RegionMask& mask, const PointView& points, const Execution& execution = {}) {
  Marks inside(points.count + 3, 7);
  mask.mark(points, inside, execution);
  return inside;
}

// What contains() says of each point, which costs more than the masks of all sets.
inline Marks contained(const std::vector<Region>& regions, const PointView& points) {
  Marks inside;
  for (std::size_t i = 0; i < points.count; ++i) {
    const Coordinates p = load_point(points, i);
    inside.push_back(is_valid(p) && std::any_of(regions.begin(), regions.end(), [&](const Region& region) {
                       return contains(inflated(region.volume, region.padding), Vector3d(p.x, p.y, p.z));
                     }));
  }
  return inside;
}

// Boxes, spheres, oriented boxes, cylinders and capsules, two of each and one of every other kind, padded.
inline std::vector<Region> ten_and_more(Random& random, const Scale& scale) {
  std::vector<Region> regions;
  for (int i = 0; i < 2; ++i) {
    for (const AnyVolume& volume : volumes_of_every_kind(random, scale))
      regions.push_back({volume, 0.02 * scale.extent * static_cast<double>(regions.size() % 4)});
  }
  return regions;
}

}  // namespace pcl_bv::testing
