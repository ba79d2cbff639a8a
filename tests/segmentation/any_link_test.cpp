// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The pair search between two cells: right, and fast where n*m tests would not be.
#include "any_link.h"

#include "any_link.cpp"  // to give it a number type of our own

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace {

using pcl_bv::detail::Point;
using pcl_bv::detail::PointRun;
using Points = std::vector<Point<float>>;

bool any_link(const Points& a, const Points& b, float r2) {
  pcl_bv::detail::LinkScratch<float> scratch;
  const PointRun<float> run_a{a.data(), a.size()};
  const PointRun<float> run_b{b.data(), b.size()};
  const bool found = pcl_bv::detail::any_link(run_a, run_b, r2, scratch);
  EXPECT_EQ(pcl_bv::detail::any_link_of_many(run_a, run_b, r2, scratch), found);
  return found;
}

float least_of_all(const Points& a, const Points& b) {
  float least = std::numeric_limits<float>::infinity();
  for (const auto& p : a) {
    for (const auto& q : b)
      least = std::min(least, pcl_bv::detail::squared_distance(p, q));
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

// A float that counts its products: three for each distance between two points or two boxes.
struct Counted {
  float value;
  static std::size_t products;

  Counted(int v) : value(static_cast<float>(v)) {}
  Counted(float v) : value(v) {}
  friend Counted operator+(Counted a, Counted b) { return a.value + b.value; }
  friend Counted operator-(Counted a, Counted b) { return a.value - b.value; }
  friend Counted operator*(Counted a, Counted b) {
    ++products;
    return a.value * b.value;
  }
  friend auto operator<=>(const Counted&, const Counted&) = default;
};
std::size_t Counted::products = 0;

TEST(AnyLink, IsFarFromQuadraticOnSheetsBarelyApart) {
  constexpr std::size_t count = 20'000;
  const auto counted = [](const Points& points) {
    std::vector<Point<Counted>> all;
    for (const auto& p : points)
      all.push_back({p.x, p.y, p.z});
    return all;
  };
  const auto a = counted(sheet(count, 0.F, 1)), b = counted(sheet(count, 0.45F, 2));
  const float nearly =
      0.159F;  // r = 0.39875; the sheets are at least (0.45 - 0.004) / sqrt(1.25) = 0.3989 apart
  pcl_bv::detail::LinkScratch<Counted> scratch;
  EXPECT_FALSE(
      pcl_bv::detail::any_link_of_many<Counted>({a.data(), count}, {b.data(), count}, nearly, scratch));
  EXPECT_LT(Counted::products / 3, 10 * std::pow(count, 1.5)) << "all pairs would be " << count * count;
}

}  // namespace
