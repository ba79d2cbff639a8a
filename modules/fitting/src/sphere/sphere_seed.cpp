// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "sphere/sphere_seed.h"

#include <algorithm>
#include <array>

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

SmallBall SeedPoints::ball_of_support(const LocalFrame& frame, const SmallBall& ball) const {
  std::array<std::size_t, 4> support = ball.support;
  const auto size = static_cast<std::size_t>(ball.support_size);
  std::sort(support.begin(), support.begin() + size,
            [&](std::size_t a, std::size_t b) { return seeds_[a].index < seeds_[b].index; });
  std::array<Eigen::Vector3d, 4> points;
  for (std::size_t i = 0; i < size; ++i)
    points[i] = frame.local(seeds_[support[i]].point);
  SmallBall same = detail::smallest_ball(points.data(), size);
  for (std::size_t i = 0; i < static_cast<std::size_t>(same.support_size); ++i)
    same.support[i] = support[same.support[i]];
  return same;
}

double SeedPoints::greatest_distance(const DistanceCenter& center) const {
  double greatest = 0;
  for (const Seed& seed : seeds_)
    greatest = std::max(greatest, squared_distance(seed.point, center));
  return greatest;
}

}  // namespace pcl_bv::detail
