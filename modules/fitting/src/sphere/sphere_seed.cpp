// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "sphere/sphere_seed.h"

#include <algorithm>

#include "same_points.h"

namespace pcl_bv::detail {

SeedPoints::SeedPoints(const Supports& supports) {
  for (std::size_t k = 0; k < direction_count(supports.set); ++k) {
    seeds_.push_back({supports.along[k].low_point.index, supports.along[k].low_point.point});
    seeds_.push_back({supports.along[k].high_point.index, supports.along[k].high_point.point});
  }
  make_unique();
}

SeedPoints::SeedPoints(const PointView& points, const Supports& supports) {
  for_each_valid(points, supports, [&](std::size_t index, const Coordinates& p) {
    seeds_.push_back({index, p});
  });
  make_unique();
}

void SeedPoints::make_unique() {
  std::sort(seeds_.begin(), seeds_.end(), [](const Seed& a, const Seed& b) { return a.index < b.index; });
  const auto same = [](const Seed& a, const Seed& b) { return a.index == b.index; };
  seeds_.erase(std::unique(seeds_.begin(), seeds_.end(), same), seeds_.end());
}

bool SeedPoints::add(std::size_t index, const Coordinates& point) {
  if (std::any_of(seeds_.begin(), seeds_.end(), [&](const Seed& s) { return s.index == index; }))
    return false;
  seeds_.push_back({index, point});
  return true;
}

SmallBall SeedPoints::smallest_ball(const LocalFrame& frame, const SmallBall* start) const {
  SmallVector<Eigen::Vector3d, 128> local(seeds_.size());
  for (std::size_t i = 0; i < seeds_.size(); ++i)
    local[i] = frame.local(seeds_[i].point);
  return detail::smallest_ball(local.data(), local.size(), start);
}

double SeedPoints::greatest_distance(const DistanceCenter& center) const {
  double greatest = 0;
  for (const Seed& seed : seeds_)
    greatest = std::max(greatest, squared_distance(seed.point, center));
  return greatest;
}

}  // namespace pcl_bv::detail
