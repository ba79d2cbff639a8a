// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/fitting/supports.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "clouds.h"
#include "directions.h"
#include "exact.h"
#include "executions.h"
#include "flush_to_zero.h"

namespace pcl_bv::detail {
namespace {

using test::Directions;
using test::Rational;
using test::TestCloud;

struct Ends {
  Rational low, high;
  std::size_t low_index = 0, high_index = 0;
};

// The definition, in rationals, which look only at points that can be either end. Ties: the smallest index.
Ends by_definition(const PointView& points, const Direction& n) {
  double rounded_low = std::numeric_limits<double>::infinity(), rounded_high = -rounded_low, terms = 0;
  for (std::size_t i = 0; i < points.count; ++i) {
    const Coordinates p = load_point(points, i);
    if (!is_valid(p)) continue;
    const test::RoundedDot s = test::rounded_dot(n, p);
    rounded_low = std::min(rounded_low, s.value);
    rounded_high = std::max(rounded_high, s.value);
    terms = std::max(terms, s.terms);
  }
  const double margin = test::kClearly * terms + test::kUnderflow;
  Ends ends;
  bool first = true;
  for (std::size_t i = 0; i < points.count; ++i) {
    const Coordinates p = load_point(points, i);
    if (!is_valid(p)) continue;
    const double rounded = test::rounded_dot(n, p).value;
    if (rounded > rounded_low + margin && rounded < rounded_high - margin) continue;
    const std::size_t index = points.index(i);
    const Rational projection = test::exact_dot(n, p);
    if (first || projection < ends.low || (projection == ends.low && index < ends.low_index)) {
      ends.low = projection;
      ends.low_index = index;
    }
    if (first || projection > ends.high || (projection == ends.high && index < ends.high_index)) {
      ends.high = projection;
      ends.high_index = index;
    }
    first = false;
  }
  return ends;
}

void expect_exact(const PointView& points, const Directions& directions) {
  const CustomSupports supports = find_supports(points, directions);
  std::size_t used = 0;
  for (std::size_t i = 0; i < points.count; ++i)
    used += is_valid(load_point(points, i)) ? 1 : 0;
  ASSERT_EQ(supports.used, used);
  ASSERT_EQ(supports.dropped, points.count - used);
  ASSERT_EQ(supports.along.size(), used == 0 ? 0 : directions.size());
  for (std::size_t k = 0; k < supports.along.size(); ++k) {
    SCOPED_TRACE(testing::Message() << "direction " << k);
    const Ends expected = by_definition(points, directions[k]);
    const Support& along = supports.along[k];
    EXPECT_EQ(along.low, test::greatest_double_below(expected.low));
    EXPECT_EQ(along.high, test::least_double_above(expected.high));
    EXPECT_EQ(along.low_point.index, expected.low_index);
    EXPECT_EQ(along.high_point.index, expected.high_index);
    EXPECT_EQ(test::exact_dot(directions[k], along.low_point.point), expected.low);
    EXPECT_EQ(test::exact_dot(directions[k], along.high_point.point), expected.high);
    EXPECT_FALSE(along.low == 0 && std::signbit(along.low));
    EXPECT_FALSE(along.high == 0 && std::signbit(along.high));
  }
}

template <typename T>
void expect_exact_on_nasty_clouds() {
  for (const TestCloud<T>& cloud : test::nasty_clouds<T>()) {
    SCOPED_TRACE(cloud.name);
    expect_exact(cloud.view(), test::random_directions(2, cloud.size()));
    if (cloud.size() <= 1025) expect_exact(cloud.view(), test::nasty_directions());
  }
}

TEST(CustomSupports, AreTheTrueOnesOfAFloatCloud) {
  expect_exact_on_nasty_clouds<float>();
}
TEST(CustomSupports, AreTheTrueOnesOfADoubleCloud) {
  expect_exact_on_nasty_clouds<double>();
}

TEST(CustomSupports, OfDoublesWhoseProductsVanishAreTheTrueOnes) {
  for (const double scale : {1e-300, 1e-310, 1e-322}) {
    TestCloud<double> cloud = test::gaussian<double>(100, 1);
    for (double& c : cloud.xyz)
      c *= scale;
    expect_exact(cloud.view(), test::nasty_directions());
  }
}

TEST(CustomSupports, OfIntegerLatticesAreTheTrueOnes) {
  TestCloud<float> cloud{"lattice", {}};
  for (int i = 0; i < 12 * 12 * 12; ++i) {
    cloud.xyz.insert(cloud.xyz.end(), {static_cast<float>(i % 12), static_cast<float>(i / 12 % 12),
                                       static_cast<float>(i / 144)});
  }
  expect_exact(cloud.view(), test::integer_directions());
}

void expect_same(const CustomSupports& a, const CustomSupports& b) {
  EXPECT_EQ(a.used, b.used);
  EXPECT_EQ(a.dropped, b.dropped);
  ASSERT_EQ(a.along.size(), b.along.size());
  for (std::size_t k = 0; k < a.along.size(); ++k) {
    SCOPED_TRACE(testing::Message() << "direction " << k);
    EXPECT_EQ(a.along[k].low, b.along[k].low);
    EXPECT_EQ(a.along[k].high, b.along[k].high);
    EXPECT_EQ(a.along[k].low_point.index, b.along[k].low_point.index);
    EXPECT_EQ(a.along[k].high_point.index, b.along[k].high_point.index);
  }
}

template <typename T>
void expect_same_for_every_execution(const TestCloud<T>& cloud, const Directions& directions) {
  const CustomSupports expected = find_supports(cloud.view(), directions, Execution(Serial{}, Isa::scalar));
  for (const auto& [name, execution] : test::every_execution()) {
    SCOPED_TRACE(cloud.name + ", " + name);
    expect_same(find_supports(cloud.view(), directions, execution), expected);
  }
}

TEST(CustomSupports, SameBitsForEveryInstructionSetAndThreadCount) {
  for (const TestCloud<float>& cloud : test::nasty_clouds<float>())
    expect_same_for_every_execution(cloud, test::nasty_directions());
  for (const TestCloud<double>& cloud : test::nasty_clouds<double>())
    expect_same_for_every_execution(cloud, test::nasty_directions());
  // Large enough to be threaded on every set, with equal ends in different chunks.
  TestCloud<float> large = test::gaussian<float>(600'000, 77);
  for (const std::size_t chunk : {1, 5, 9}) {
    for (std::size_t i = 0; i < 3000; ++i)
      large.xyz[3 * 40'000 * chunk + i] = std::round(large.xyz[i]) * 4;
  }
  expect_same_for_every_execution(large, test::integer_directions());
}

TEST(CustomSupports, AlongTheCubesDirectionsAreThoseOfTheCubesKernel) {
  Directions directions;
  for (const CubeDirection& d : kCubeDirections)
    directions.push_back({double(d[0]), double(d[1]), double(d[2])});
  for (const TestCloud<float>& cloud : test::nasty_clouds<float>()) {
    SCOPED_TRACE(cloud.name);
    const Supports expected = find_supports(cloud.view(), DirectionSet::dop26, SupportDetail::points, {});
    const CustomSupports supports = find_supports(cloud.view(), directions);
    EXPECT_EQ(supports.used, expected.used);
    for (std::size_t k = 0; k < supports.along.size(); ++k) {
      EXPECT_EQ(supports.along[k].low, expected.along[k].low);
      EXPECT_EQ(supports.along[k].high, expected.along[k].high);
      EXPECT_EQ(supports.along[k].low_point.index, expected.along[k].low_point.index);
      EXPECT_EQ(supports.along[k].high_point.index, expected.along[k].high_point.index);
    }
  }
}

TEST(CustomSupports, NameTheCloudsIndexUnderAnIndexList) {
  const TestCloud<float> cloud = test::gaussian<float>(3000, 6);
  std::vector<std::int32_t> indices(2000);
  std::iota(indices.rbegin(), indices.rend(), 500);
  expect_exact(PointView::of(cloud.xyz.data(), 12, indices.size(), indices.data()),
               test::random_directions(3, 9));
}

TEST(CustomSupports, ADirectionOfAnotherLengthHasTheSamePoints) {
  const TestCloud<float> cloud = test::gaussian<float>(5000, 12, 3, 100);
  Directions directions = test::random_directions(10, 1), longer = directions;
  for (auto& d : longer)
    d = {d[0] * 0x1p80, d[1] * 0x1p80, d[2] * 0x1p80};
  const CustomSupports a = find_supports(cloud.view(), directions);
  const CustomSupports b = find_supports(cloud.view(), longer);
  for (std::size_t k = 0; k < directions.size(); ++k) {
    EXPECT_EQ(b.along[k].high, a.along[k].high * 0x1p80);
    EXPECT_EQ(b.along[k].high_point.index, a.along[k].high_point.index);
  }
}

TEST(CustomSupports, SurviveAHostThatFlushesDenormals) {
  const TestCloud<float> cloud = test::gaussian<float>(700, 7, 1e-41);
  const Directions directions = test::random_directions(4, 2);
  const CustomSupports expected = find_supports(cloud.view(), directions);
  ASSERT_GT(expected.along[0].high, 0);
  for (const auto& [name, execution] : test::every_execution()) {
    SCOPED_TRACE(name);
    const test::FlushToZero host;
    expect_same(find_supports(cloud.view(), directions, execution), expected);
  }
}

TEST(CustomSupports, RefusesWhatIsNoDirection) {
  const TestCloud<float> cloud = test::gaussian<float>(10, 1);
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const auto find = [&](const Directions& d) { return find_supports(cloud.view(), d); };
  for (const Directions& bad :
       {Directions{}, Directions(50, {1, 0, 0}), Directions{{0, 0, 0}}, Directions{{1, nan, 0}},
        Directions{{inf, 0, 0}}, Directions{{1, 0, 0}, {0.9e-30, 0, 0}}, Directions{{0, 1.1e30, 0}}}) {
    EXPECT_THROW(find(bad), std::invalid_argument);
  }
  EXPECT_NO_THROW(find({{1e-30, 0, 0}, {-1e30, 0, 0}}));
  const Isa foreign =
      usable_isas().back() == Isa::neon || usable_isas().back() > Isa::neon ? Isa::avx2 : Isa::neon;
  EXPECT_THROW(find_supports(cloud.view(), {{1, 0, 0}}, Execution(Serial{}, foreign)), std::invalid_argument);
}

}  // namespace
}  // namespace pcl_bv::detail
