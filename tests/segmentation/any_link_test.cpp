// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The pair search between two cells: right, and fast where n*m tests would not be.
#include "any_link.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace {

using pcl_bv::Point;
using pcl_bv::PointRun;
using Points = std::vector<Point<float>>;

bool any_link(const Points& a, const Points& b, float r2) {
  pcl_bv::LinkScratch<float> scratch;
  const PointRun<float> run_a{a.data(), a.size()};
  const PointRun<float> run_b{b.data(), b.size()};
  const bool found = pcl_bv::any_link(run_a, run_b, r2, scratch);
  EXPECT_EQ(pcl_bv::any_link_of_many(run_a, run_b, r2, scratch), found);
  return found;
}

float least_of_all(const Points& a, const Points& b) {
  float least = std::numeric_limits<float>::infinity();
  for (const auto& p : a) {
    for (const auto& q : b)
      least = std::min(least, pcl_bv::squared_distance(p, q));
  }
  return least;
}

// A sheet that leans and waves, so that boxes of its parts reach far above and below it.
Points sheet(std::size_t count, float height, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> coordinate(0.F, 0.28F);
  Points points(count);
  for (auto& p : points) {
    p.x = coordinate(random);
    p.y = coordinate(random);
    p.z = height + 0.5F * p.x + 0.002F * std::sin(60.F * p.y);
  }
  return points;
}

TEST(AnyLink, FindsTheClosestPairAndNothingBelowIt) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const Points a = sheet(1 + 7 * seed, 0.F, seed);
    const Points b = sheet(1500 - 7 * seed, 0.3F, seed + 1000);
    const float least = least_of_all(a, b);
    EXPECT_FALSE(any_link(a, b, least));
    EXPECT_TRUE(any_link(a, b, std::nextafter(least, 1.F)));
  }
}

TEST(AnyLink, LeavesACrossApartWhoseArmsAreAllAtTheTolerance) {
  const Points a{{-1, 0, 0}, {1, 0, 0}};
  const Points b{{0, -1, 0}, {0, 1, 0}};
  EXPECT_FALSE(any_link(a, b, 2.F));
  EXPECT_TRUE(any_link(a, b, 2.000001F));
}

TEST(AnyLink, HandlesManyEqualPoints) {
  const Points a(5000, {0, 0, 0});
  Points b(5000, {1, 0, 0});
  b[4321] = {0.5F, 0, 0};
  EXPECT_FALSE(any_link(a, b, 0.25F));
  EXPECT_TRUE(any_link(a, b, 0.2500001F));
}

TEST(AnyLink, IsFarFromQuadraticOnSheetsBarelyApart) {
  const Points a = sheet(150'000, 0.F, 1);
  const Points b = sheet(150'000, 0.45F, 2);
  const float nearly =
      0.159F;  // r = 0.39875; the sheets are at least (0.45 - 0.004) / sqrt(1.25) = 0.3989 apart
  const auto start = std::chrono::steady_clock::now();
  EXPECT_FALSE(any_link(a, b, nearly));
  // 2e10 pair tests would take longer.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(12));
}

}  // namespace
