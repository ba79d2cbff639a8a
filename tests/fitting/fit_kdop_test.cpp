// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// k-DOPs along directions of one's own, and which points touch the slabs.

#include <gtest/gtest.h>

#include <cmath>

#include "clouds.h"
#include "directions.h"
#include "exact.h"
#include "executions.h"
#include "fits.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/numeric/directions.h"

namespace pcl_bv::detail {
namespace {

using test::Rational;
using test::TestCloud;

std::shared_ptr<const KdopSet> set_along(const test::Directions& directions) {
  std::vector<Eigen::Vector3d> all;
  for (const auto& d : directions)
    all.emplace_back(d[0], d[1], d[2]);
  return std::make_shared<const KdopSet>(all);
}

TEST(FitKdop, OfAnyDirectionsIsThatOfExtendingPointByPoint) {
  for (const auto& set : {set_along(test::random_directions(11, 1)), set_along(test::integer_directions()),
                          set_along({{1e-30, 3e-31, -2e-30}, {1e30, -3e29, 7e29}, {0, 0, -1}})}) {
    for (const TestCloud<float>& cloud : test::nasty_clouds<float>()) {
      SCOPED_TRACE(cloud.name);
      Kdop expected(set), kdop;
      for (std::size_t i = 0; i < cloud.size(); ++i) {
        const Coordinates p = load_point(cloud.view(), i);
        if (is_valid(p)) expected.extend({p.x, p.y, p.z});
      }
      kdop = *fit_kdop(cloud.view(), set);
      EXPECT_EQ(kdop, expected);
    }
  }
}

TEST(FitKdop, OfAnyDirectionsHasTheSameBitsForEveryExecution) {
  const auto set = set_along(test::random_directions(17, 2));
  std::vector<TestCloud<float>> clouds = test::nasty_clouds<float>();
  clouds.push_back(test::gaussian<float>(600'000, 79));
  for (const TestCloud<float>& cloud : clouds) {
    Kdop expected = *fit_kdop(cloud.view(), set, {Serial{}, Isa::scalar});
    for (const auto& [name, execution] : test::every_execution()) {
      SCOPED_TRACE(cloud.name + ", " + name);
      Kdop kdop = *fit_kdop(cloud.view(), set, execution);
      EXPECT_EQ(kdop, expected);
    }
  }
}

TEST(FitKdop, OfTheCubesDirectionsIsTheBuiltInOne) {
  test::Directions directions;
  for (const auto& d : kCubeDirections)
    directions.push_back({double(d[0]), double(d[1]), double(d[2])});
  const auto set = set_along(directions);
  ASSERT_EQ(*set, *KdopSet::dop26());
  for (const TestCloud<double>& cloud : test::nasty_clouds<double>()) {
    SCOPED_TRACE(cloud.name);
    Kdop kdop, expected;
    SlabPoints touching, expected_touching;
    const EstimationResult result = test::take(fit_kdop_with_contacts(cloud.view(), set), kdop, touching);
    const EstimationResult built_in =
        test::take(fit_kdop_with_contacts(cloud.view(), KdopSet::dop26()), expected, expected_touching);
    EXPECT_EQ(kdop, expected);
    EXPECT_EQ(touching.min, expected_touching.min);
    EXPECT_EQ(touching.max, expected_touching.max);
    EXPECT_EQ(result.status, built_in.status);
    EXPECT_EQ(result.rank, built_in.rank);
    EXPECT_EQ(result.used, built_in.used);
    EXPECT_EQ(result.dropped, built_in.dropped);
  }
}

TEST(FitKdop, TheRankAlongAnyDirectionsIsThatOfThePoints) {
  const auto set = set_along({{0.1, 0.2, -0.2}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  TestCloud<float> plane{"plane across (1, 2, -2)", {}};
  for (int i = 0; i < 100; ++i) {
    const float x = static_cast<float>(2 * (i % 10)), y = static_cast<float>(i / 10) + 0.3F;
    plane.xyz.insert(plane.xyz.end(), {x, y, x / 2 + y + 3});
  }
  Kdop kdop;
  const EstimationResult result = test::take(fit_kdop(plane.view(), set), kdop);
  EXPECT_EQ(result.rank, 3) << "x / 2 + y rounds for some points";
  for (std::size_t i = 1; i < plane.xyz.size(); i += 3) {
    plane.xyz[i] = std::round(plane.xyz[i]);
    plane.xyz[i + 1] = plane.xyz[i - 1] / 2 + plane.xyz[i] + 3;
  }
  EXPECT_EQ(test::take(fit_kdop(plane.view(), set), kdop).rank, 2);
  EXPECT_LT(kdop.min(0), kdop.max(0)) << "-3 times 0.2 is no double: the flat slab has a width";
  EXPECT_EQ(test::take(fit_kdop(plane.view(), set), kdop).status, EstimationStatus::degenerate);
  EXPECT_EQ(test::take(fit_kdop(plane.view().slice(0, 1), set), kdop).rank, 0);
  EXPECT_EQ(test::take(fit_kdop(plane.view().slice(0, 2), set), kdop).rank, 1);
}

// Whether no point lies beyond point `end` along n, and none as far that has a smaller index.
void expect_end(const PointView& points, const Eigen::Vector3d& n, std::size_t end) {
  const Coordinates e = load_point(points, end);
  const test::RoundedDot rounded = test::rounded_dot(n, e);
  const Rational exact = test::exact_dot(n, e);
  for (std::size_t i = 0; i < points.count; ++i) {
    const Coordinates p = load_point(points, i);
    if (!is_valid(p)) continue;
    const test::RoundedDot s = test::rounded_dot(n, p);
    if (s.value < rounded.value - test::kClearly * (s.terms + rounded.terms) - test::kUnderflow) continue;
    const Rational projection = test::exact_dot(n, p);
    ASSERT_TRUE(projection < exact || (projection == exact && i >= end)) << "point " << i;
  }
}

template <typename T>
void expect_touching(const std::shared_ptr<const KdopSet>& set) {
  for (const TestCloud<T>& cloud : test::nasty_clouds<T>()) {
    SCOPED_TRACE(cloud.name);
    Kdop kdop;
    SlabPoints touching{{7}, {7}};
    const EstimationResult result = test::take(fit_kdop_with_contacts(cloud.view(), set), kdop, touching);
    ASSERT_EQ(touching.min.size(), result.used == 0 ? 0 : set->size());
    ASSERT_EQ(touching.max.size(), touching.min.size());
    for (std::size_t k = 0; k < touching.min.size(); ++k) {
      SCOPED_TRACE(testing::Message() << "slab " << k);
      const Eigen::Vector3d& n = set->direction(k);
      expect_end(cloud.view(), -n, touching.min[k]);
      expect_end(cloud.view(), n, touching.max[k]);
      const auto along = [&](std::size_t i) { return test::exact_dot(n, load_point(cloud.view(), i)); };
      EXPECT_EQ(kdop.min(k), test::greatest_double_below(along(touching.min[k])));
      EXPECT_EQ(kdop.max(k), test::least_double_above(along(touching.max[k])));
    }
  }
}

TEST(FitKdop, SlabPointsTouchTheirSlabsAndHaveTheSmallestIndex) {
  const auto own = set_along({{0.1, 0.2, -0.2}, {1, 2, -1}, {0, -3, 0}});
  for (const auto& set : {KdopSet::dop6(), KdopSet::dop18(), own}) {
    expect_touching<float>(set);
    expect_touching<double>(set);
  }
}

TEST(FitKdop, AskingForTheSlabPointsDoesNotChangeTheKdop) {
  for (const auto& set : {KdopSet::dop6(), KdopSet::dop14(), set_along(test::random_directions(5, 3))}) {
    for (const TestCloud<float>& cloud : test::nasty_clouds<float>()) {
      SCOPED_TRACE(cloud.name);
      Kdop a, b;
      SlabPoints touching;
      EXPECT_EQ(test::take(fit_kdop_with_contacts(cloud.view(), set), a, touching).rank,
                test::take(fit_kdop(cloud.view(), set), b).rank);
      EXPECT_EQ(a, b);
    }
  }
}

TEST(FitKdop, ANullSetIsAnError) {
  const TestCloud<float> cloud = test::gaussian<float>(10, 1);
  Kdop kdop;
  SlabPoints touching;
  EXPECT_THROW(test::take(fit_kdop(cloud.view(), nullptr), kdop), std::invalid_argument);
  EXPECT_THROW(test::take(fit_kdop_with_contacts(cloud.view(), nullptr), kdop, touching),
               std::invalid_argument);
}

}  // namespace
}  // namespace pcl_bv::detail
