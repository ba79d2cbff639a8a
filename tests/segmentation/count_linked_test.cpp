// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "count_linked.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace pcl_bv::detail {
namespace {

// Coordinates are multiples of 1/8, so that some pairs are exactly as far apart as the tolerance.
template <typename T>
std::vector<Point<T>> points_of_seed(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> eighths(-8, 8);
  std::vector<Point<T>> points(300);
  for (Point<T>& p : points)
    p = {T(eighths(random)) / 8, T(eighths(random)) / 8, T(eighths(random)) / 8};
  return points;
}

template <typename T>
class CountLinked : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(CountLinked, Scalars);

TYPED_TEST(CountLinked, CountsThePointsThatOneComparisonAtATimeFinds) {
  using T = TypeParam;
  for (unsigned seed = 0; seed < 50; ++seed) {
    const std::vector<Point<T>> points = points_of_seed<T>(seed);
    PointColumns<T> columns;
    columns.assign(points);
    std::mt19937 random(seed);
    std::vector<PositionRange> runs;
    for (std::uint32_t begin = 0; begin < points.size();) {  // empty runs, and runs longer than a register
      const auto length = static_cast<std::uint32_t>(random() % 40);
      const auto end = std::min<std::uint32_t>(begin + length, static_cast<std::uint32_t>(points.size()));
      runs.push_back({begin, end});
      begin = end + static_cast<std::uint32_t>(random() % 3);
    }
    const Point<T> p = points[random() % points.size()];
    std::size_t expected = 0;
    for (const PositionRange& run : runs) {
      for (std::uint32_t i = run.begin; i < run.end; ++i)
        expected += squared_distance(points[i], p) < T(0.5) ? 1 : 0;
    }
    EXPECT_EQ(columns.count_linked(runs.data(), runs.size(), p, T(0.5), points.size()), expected) << seed;
    const std::size_t enough = columns.count_linked(runs.data(), runs.size(), p, T(0.5), 5);
    EXPECT_EQ(enough >= 5, expected >= 5) << seed;
    EXPECT_LE(enough, expected) << seed;
  }
}

TYPED_TEST(CountLinked, StopsSoonAfterEnoughAreFound) {
  PointColumns<TypeParam> columns;
  columns.assign(std::vector<Point<TypeParam>>(3000, {1, 2, 3}));
  const PositionRange all{0, 3000};
  const std::size_t found = columns.count_linked(&all, 1, {1, 2, 3}, 1, 5);
  EXPECT_GE(found, 5U);
  EXPECT_LT(found, 1000U);
}

TYPED_TEST(CountLinked, OfNoPointsOrRunsIsZero) {
  PointColumns<TypeParam> columns;
  columns.assign({});
  EXPECT_EQ(columns.count_linked(nullptr, 0, {0, 0, 0}, 1, 1), 0U);
  const PositionRange empty{0, 0};
  EXPECT_EQ(columns.count_linked(&empty, 1, {0, 0, 0}, 1, 1), 0U);
}

}  // namespace
}  // namespace pcl_bv::detail
