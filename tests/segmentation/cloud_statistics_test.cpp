// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/segmentation/cloud_statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace pcl_bv::detail {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

PointView view(const std::vector<float>& xyz) {
  return PointView::of(xyz.data(), 12, xyz.size() / 3);
}

// The middle one of the distances from each point to the nearest other one.
double spacing_by_brute_force(const PointView& points) {
  std::vector<Coordinates> used;
  for (std::size_t i = 0; i < points.count; ++i) {
    const Coordinates p = load_point(points, i);
    if (is_valid(p) && (p.x != 0 || p.y != 0 || p.z != 0)) used.push_back(p);
  }
  std::vector<double> nearest(used.size(), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < used.size(); ++i) {
    for (std::size_t j = 0; j < used.size(); ++j) {
      const double d = std::hypot(used[i].x - used[j].x, used[i].y - used[j].y, used[i].z - used[j].z);
      if (i != j) nearest[i] = std::min(nearest[i], d);
    }
  }
  std::sort(nearest.begin(), nearest.end());
  return nearest[nearest.size() / 2];
}

TEST(CloudStatistics, CountsBadPointsAndDeadBeamsAndBoxesTheOthers) {
  const std::vector<float> xyz{0, 2, 0,  0, 0, 0,        nan, 1, 1, 5, 0, 0,
                               0, 0, -3, 1, 1, INFINITY, 0,   4, 1, 0, 0, 0};
  const CloudStatistics found = cloud_statistics(view(xyz));
  EXPECT_EQ(found.nonfinite, 2U);
  EXPECT_EQ(found.zero, 2U);
  EXPECT_EQ(found.box, Aabb({0, 0, -3}, {5, 4, 1}));
}

TEST(CloudStatistics, OfFewerThanTwoPointsThereIsNoSpacing) {
  EXPECT_FALSE(cloud_statistics(view({})).spacing);
  EXPECT_TRUE(cloud_statistics(view({0, 0, 0, nan, 0, 0})).box.empty());
  EXPECT_FALSE(cloud_statistics(view({0, 0, 0, 1, 2, 3})).spacing);
  EXPECT_EQ(cloud_statistics(view({1, 2, 2, 1, 2, 3, nan, 0, 0})).spacing, 1);
}

TEST(CloudStatistics, SpacingOfAThousandPointsIsThatOfBruteForce) {
  std::mt19937 random(7);
  for (const float spread : {1.0F, 0.01F, 100.0F}) {
    std::uniform_real_distribution<float> wide(-50, 50), narrow(-spread, spread);
    for (const std::size_t count : {2UL, 3UL, 10UL, 400UL, 1000UL}) {
      std::vector<float> xyz;
      for (std::size_t i = 0; i < count; ++i)
        xyz.insert(xyz.end(), {narrow(random), wide(random), narrow(random)});
      for (std::size_t i = 0; i < count / 50; ++i)
        xyz.insert(xyz.begin() + static_cast<std::ptrdiff_t>(150 * i), {nan, 0, 0, 0, 0, 0});
      EXPECT_EQ(cloud_statistics(view(xyz)).spacing, spacing_by_brute_force(view(xyz)))
          << spread << ' ' << count;
    }
  }
}

TEST(CloudStatistics, OfManyPointsAreTheSameInAnyOrderOfALatticeAndOnAnyThreads) {
  std::vector<std::size_t> cells(120'000);
  for (std::size_t i = 0; i < cells.size(); ++i)
    cells[i] = i;
  for (int order = 0; order < 2; ++order) {
    std::vector<float> xyz;
    for (const std::size_t i : cells)
      xyz.insert(xyz.end(),
                 {0.25F * static_cast<float>(i % 400 + 1), 0.5F * static_cast<float>(i / 400), -2});
    for (const unsigned threads : {1U, 3U}) {
      const CloudStatistics found = cloud_statistics(view(xyz), Threads{threads});
      EXPECT_EQ(found.spacing, 0.25);
      EXPECT_EQ(found.box, Aabb({0.25, 0, -2}, {100, 149.5, -2}));
      EXPECT_EQ(found.nonfinite + found.zero, 0U);
    }
    std::shuffle(cells.begin(), cells.end(), std::mt19937(3));
  }
}

}  // namespace
}  // namespace pcl_bv::detail
