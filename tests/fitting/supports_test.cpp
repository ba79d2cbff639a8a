// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/fitting/supports.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "clouds.h"
#include "exact.h"
#include "executions.h"
#include "flush_to_zero.h"
#include "pcl_bv/points/point_source.h"

namespace pcl_bv::detail {
namespace {

using test::Rational;
using test::TestCloud;

constexpr DirectionSet kSets[] = {DirectionSet::dop6, DirectionSet::dop14, DirectionSet::dop18,
                                  DirectionSet::dop26};

// Least and greatest projection of the valid points. Rationals look only at points that can be either.
std::pair<Rational, Rational> exact_extent(const PointView& points, const std::array<int, 3>& direction) {
  double rounded_low = std::numeric_limits<double>::infinity(), rounded_high = -rounded_low, terms = 0;
  for (std::size_t i = 0; i < points.count; ++i) {
    const Coordinates p = load_point(points, i);
    if (!is_valid(p)) continue;
    const test::RoundedDot s = test::rounded_dot(direction, p);
    rounded_low = std::min(rounded_low, s.value);
    rounded_high = std::max(rounded_high, s.value);
    terms = std::max(terms, s.terms);
  }
  const double margin = test::kClearly * terms;
  std::optional<std::pair<Rational, Rational>> extent;
  for (std::size_t i = 0; i < points.count; ++i) {
    const Coordinates p = load_point(points, i);
    if (!is_valid(p)) continue;
    const double s = test::rounded_dot(direction, p).value;
    if (s > rounded_low + margin && s < rounded_high - margin) continue;
    const Rational exact = test::exact_dot(direction, p);
    if (!extent) extent.emplace(exact, exact);
    extent->first = std::min(extent->first, exact);
    extent->second = std::max(extent->second, exact);
  }
  return extent.value();
}

// The definition, in rationals.
void expect_exact(const PointView& points, const Supports& supports) {
  std::size_t used = 0;
  for (std::size_t i = 0; i < points.count; ++i)
    used += is_valid(load_point(points, i)) ? 1 : 0;
  ASSERT_EQ(supports.used, used);
  ASSERT_EQ(supports.dropped, points.count - used);
  if (used == 0) return;
  for (std::size_t k = 0; k < direction_count(supports.set); ++k) {
    const auto& d = kCubeDirections[cube_direction(supports.set, k)];
    const auto [low, high] = exact_extent(points, std::array<int, 3>{d[0], d[1], d[2]});
    EXPECT_EQ(supports.along[k].low, test::greatest_double_below(low)) << "direction " << k;
    EXPECT_EQ(supports.along[k].high, test::least_double_above(high)) << "direction " << k;
    EXPECT_FALSE(supports.along[k].low == 0 && std::signbit(supports.along[k].low));
    EXPECT_FALSE(supports.along[k].high == 0 && std::signbit(supports.along[k].high));
  }
}

template <typename T>
void expect_exact_on_nasty_clouds() {
  for (const TestCloud<T>& cloud : test::nasty_clouds<T>()) {
    SCOPED_TRACE(cloud.name);
    expect_exact(cloud.view(), find_supports(cloud.view(), DirectionSet::dop26, SupportDetail::bounds, {}));
  }
}

TEST(Supports, AreTheTrueOnesRoundedOutwardForFloat) {
  expect_exact_on_nasty_clouds<float>();
}
TEST(Supports, AreTheTrueOnesRoundedOutwardForDouble) {
  expect_exact_on_nasty_clouds<double>();
}

TEST(Supports, OfASetAreThoseOfItsDirections) {
  const TestCloud<float> cloud = test::gaussian<float>(5000, 1, 1, 5e6);
  for (const DirectionSet set : kSets) {
    expect_exact(cloud.view(), find_supports(cloud.view(), set, SupportDetail::bounds, {}));
  }
}

TEST(Supports, OfTwoBlocksTheOneThatIsOnlyRoundedToMoreDoesNotWin) {
  // Float differences of 1e7 are off by up to half a metre, their sums by more: the lesser of two may be
  // rounded to the greater.
  const TestCloud<float> others = test::gaussian<float>(2 * kBlockPoints, 14, 1000, -5e6);
  std::mt19937_64 random(14);
  for (int round = 0; round < 200; ++round) {
    SCOPED_TRACE(testing::Message() << "round " << round);
    TestCloud<float> cloud = others;
    for (const std::size_t i : {std::size_t{7}, kBlockPoints + 7}) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        cloud.xyz[3 * i + axis] = 5e6F + 0.5F * static_cast<float>(random() % 4);
    }
    expect_exact(cloud.view(), find_supports(cloud.view(), DirectionSet::dop26, SupportDetail::bounds, {}));
  }
}

TEST(Supports, OfTwoChunksTheOneThatReachesFartherByALastBitWins) {
  // Far from the origin along one axis; the second chunk is the first, each point a last bit farther out
  // along the other two, which double sums cannot tell.
  const TestCloud<double> offsets = test::gaussian<double>(kChunkPoints, 15);
  for (int far = 0; far < 6; ++far) {
    SCOPED_TRACE(testing::Message() << "seed 15, far along " << far);
    std::array<double, 3> center = {3, -5, 7};
    center[far / 2] = far % 2 == 0 ? 1e6 : -1e6;
    TestCloud<double> cloud{"two chunks", {}};
    for (const double out : {0.0, std::numeric_limits<double>::infinity()}) {
      for (std::size_t i = 0; i < offsets.xyz.size(); ++i) {
        const double value = center[i % 3] + offsets.xyz[i];
        const bool same = out == 0 || i % 3 == static_cast<std::size_t>(far / 2);
        cloud.xyz.push_back(same ? value : std::nextafter(value, std::copysign(out, offsets.xyz[i])));
      }
    }
    expect_exact(cloud.view(), find_supports(cloud.view(), DirectionSet::dop26, SupportDetail::bounds, {}));
  }
}

void expect_same(const Supports& a, const Supports& b) {
  EXPECT_EQ(a.used, b.used);
  for (std::size_t k = 0; k < kMaxDirections; ++k) {
    EXPECT_EQ(a.along[k].low, b.along[k].low) << "direction " << k;
    EXPECT_EQ(a.along[k].high, b.along[k].high) << "direction " << k;
    EXPECT_EQ(a.along[k].low_point.index, b.along[k].low_point.index) << "direction " << k;
    EXPECT_EQ(a.along[k].high_point.index, b.along[k].high_point.index) << "direction " << k;
  }
}

TEST(Supports, SameBitsForEveryInstructionSetAndThreadCount) {
  std::vector<TestCloud<float>> clouds = test::nasty_clouds<float>();
  clouds.push_back(test::gaussian<float>(test::kThreadedPoints, 77));
  for (const TestCloud<float>& cloud : clouds) {
    const Execution reference{Serial{}, Isa::scalar};
    const Supports expected =
        find_supports(cloud.view(), DirectionSet::dop26, SupportDetail::points, reference);
    for (const auto& [name, execution] : test::every_execution()) {
      SCOPED_TRACE(cloud.name + ", " + name);
      expect_same(find_supports(cloud.view(), DirectionSet::dop26, SupportDetail::points, execution),
                  expected);
    }
  }
}

TEST(Supports, TiesGoToTheSmallestIndexWhereverTheBlocksLie) {
  TestCloud<float> cloud{"all equal but one", std::vector<float>(3 * 5000, 1.0F)};
  cloud.xyz[3 * 2500] = 2.0F;
  const Supports supports = find_supports(cloud.view(), DirectionSet::dop26, SupportDetail::points, {});
  EXPECT_EQ(supports.along[0].high_point.index, 2500U);
  EXPECT_EQ(supports.along[0].low_point.index, 0U);
  EXPECT_EQ(supports.along[1].high_point.index, 0U);
  EXPECT_EQ(supports.along[12].high_point.index, 0U);
}

TEST(Supports, DoNotDependOnTheOrderOfAnIndexList) {
  const TestCloud<float> cloud = test::gaussian<float>(3000, 6);
  std::vector<std::int32_t> indices(3000);
  std::iota(indices.rbegin(), indices.rend(), 0);
  const PointView reversed = PointView::of(cloud.xyz.data(), 12, indices.size(), indices.data());
  expect_same(find_supports(reversed, DirectionSet::dop26, SupportDetail::points, {}),
              find_supports(cloud.view(), DirectionSet::dop26, SupportDetail::points, {}));
}

TEST(Supports, TranslateExactlyByPowersOfTwo) {
  // Coordinates on a grid of 2^-10 stay exact when 2^12 is added, so every extreme moves by just that.
  TestCloud<float> cloud = test::gaussian<float>(4000, 12);
  for (float& c : cloud.xyz)
    c = std::round(c * 1024.0F) / 1024.0F;
  TestCloud<float> moved = cloud;
  for (std::size_t i = 0; i < moved.xyz.size(); i += 3)
    moved.xyz[i] += 4096.0F;
  const Supports a = find_supports(cloud.view(), DirectionSet::dop26, SupportDetail::points, {});
  const Supports b = find_supports(moved.view(), DirectionSet::dop26, SupportDetail::points, {});
  for (std::size_t k = 0; k < kMaxDirections; ++k) {
    EXPECT_EQ(b.along[k].low, a.along[k].low + 4096.0 * kCubeDirections[k][0]);
    EXPECT_EQ(b.along[k].high, a.along[k].high + 4096.0 * kCubeDirections[k][0]);
    EXPECT_EQ(b.along[k].high_point.index, a.along[k].high_point.index);
  }
}

TEST(Supports, SurviveAHostThatFlushesDenormals) {
  const TestCloud<float> cloud = test::gaussian<float>(700, 7, 1e-41);
  const Supports expected = find_supports(cloud.view(), DirectionSet::dop26, SupportDetail::points, {});
  ASSERT_GT(expected.along[0].high, 0);
  for (const auto& [name, execution] : test::every_execution()) {
    SCOPED_TRACE(name);
    const test::FlushToZero host;
    expect_same(find_supports(cloud.view(), DirectionSet::dop26, SupportDetail::points, execution), expected);
  }
}

TEST(Supports, RankIsThatOfThePointsAlongWhateverDirections) {
  const auto rank = [](std::vector<float> xyz, DirectionSet set) {
    const PointView points = PointView::of(xyz.data(), 12, xyz.size() / 3);
    return result_of(find_supports(points, set, SupportDetail::bounds, {})).rank;
  };
  EXPECT_EQ(rank({1, 2, 3}, DirectionSet::dop6), 0);
  EXPECT_EQ(rank({0, 0, 0, 5, 0, 0}, DirectionSet::dop26), 1);
  EXPECT_EQ(rank({0, 0, 0, 1, 1, 0, 3, 1, 0}, DirectionSet::dop6), 2);
  EXPECT_EQ(rank({0, 0, 0, 1, -1, 0, 0, 0, 1}, DirectionSet::dop6), 2) << "a tilted plane";
  EXPECT_EQ(rank({0, 0, 0, 1, -1, 0, 0, 0, 1}, DirectionSet::dop26), 2);
  EXPECT_EQ(rank({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, DirectionSet::dop26), 3);
}

TEST(Supports, OfNoCloudAreThoseOfNothing) {
  EXPECT_EQ(result_of(Supports()).status, EstimationStatus::no_valid_points);
  EXPECT_EQ(result_of(Supports()).rank, 0);
}

TEST(Supports, AnUnusableInstructionSetIsAnError) {
  const TestCloud<float> cloud = test::gaussian<float>(10, 1);
  const Isa foreign =
      usable_isas().back() == Isa::neon || usable_isas().back() > Isa::neon ? Isa::avx2 : Isa::neon;
  EXPECT_THROW(
      find_supports(cloud.view(), DirectionSet::dop6, SupportDetail::bounds, Execution(Serial{}, foreign)),
      std::invalid_argument);
}

}  // namespace
}  // namespace pcl_bv::detail
