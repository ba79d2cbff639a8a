// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/kernels/support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <numeric>

#include "clouds.h"
#include "pcl_bv/kernels/axis_extents.h"
#include "pcl_bv/points/point_groups.h"
#include "pcl_bv/points/point_source.h"
#include "supports_by_definition.h"

namespace pcl_bv::detail {
namespace {

using test::by_definition;
using test::expect_same;
using test::Records;
using test::run;
using test::TestCloud;

constexpr DirectionSet kSets[] = {DirectionSet::dop6, DirectionSet::dop14, DirectionSet::dop18,
                                  DirectionSet::dop26};

// Bits, not values: -0 differs from 0.
template <typename Value>
bool same_bits(const Value& a, const Value& b) {
  return std::memcmp(&a, &b, sizeof(Value)) == 0;
}

void expect_same(const AxisExtents& a, const AxisExtents& b) {
  EXPECT_EQ(a.dropped, b.dropped);
  EXPECT_TRUE(same_bits(a.low, b.low)) << a.low[0] << ' ' << a.low[1] << ' ' << a.low[2] << " and "
                                       << b.low[0] << ' ' << b.low[1] << ' ' << b.low[2];
  EXPECT_TRUE(same_bits(a.high, b.high)) << a.high[0] << ' ' << a.high[1] << ' ' << a.high[2] << " and "
                                         << b.high[0] << ' ' << b.high[1] << ' ' << b.high[2];
}

AxisExtents box_by_definition(const PointView& points) {
  AxisExtents out{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}, 0};
  for (std::size_t i = 0; i < points.count; ++i) {
    const Coordinates p = load_point(points, i);
    if (!is_valid(p)) {
      ++out.dropped;
      continue;
    }
    const double v[3] = {p.x, p.y, p.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      out.low[axis] = std::min(out.low[axis], v[axis]) + 0.0;
      out.high[axis] = std::max(out.high[axis], v[axis]) + 0.0;
    }
  }
  return out;
}

class CubeSupports : public testing::TestWithParam<Isa> {
 protected:
  template <typename T>
  void expect_definition(const PointView& points) {
    expect_same(axis_extents(GetParam(), points), box_by_definition(points));
    for (const DirectionSet set : kSets) {
      SCOPED_TRACE("directions " + std::to_string(direction_count(set)));
      const SupportDirections& directions = SupportDirections::of(set);
      expect_same(run(GetParam(), points, directions), by_definition(points, directions), directions.count);
    }
  }
};

TEST_P(CubeSupports, AreThoseOfTheDefinitionForFloat) {
  for (const TestCloud<float>& cloud : test::nasty_clouds<float>()) {
    SCOPED_TRACE(cloud.name);
    expect_definition<float>(cloud.view());
  }
}

TEST_P(CubeSupports, AreThoseOfTheDefinitionForDouble) {
  for (const TestCloud<double>& cloud : test::nasty_clouds<double>()) {
    SCOPED_TRACE(cloud.name);
    expect_definition<double>(cloud.view());
  }
}

TEST_P(CubeSupports, AreThoseOfTheDefinitionForEveryStrideOffsetAndTail) {
  for (std::size_t n = 1; n <= 3 * 16 + 1; ++n) {
    const TestCloud<float> cloud = test::gaussian<float>(n, n);
    for (const auto& [stride, offset] : std::vector<std::pair<std::size_t, std::size_t>>{{12, 0},
                                                                                         {16, 0},
                                                                                         {16, 4},
                                                                                         {20, 0},
                                                                                         {29, 13},
                                                                                         {31, 3},
                                                                                         {32, 0},
                                                                                         {32, 16},
                                                                                         {32, 20},
                                                                                         {48, 0},
                                                                                         {48, 32}}) {
      SCOPED_TRACE(testing::Message() << n << " points, stride " << stride << ", offset " << offset);
      expect_definition<float>(Records<float>(cloud, stride, offset).view());
    }
    for (const std::size_t stride : {24, 32, 40}) {
      SCOPED_TRACE(testing::Message() << n << " double points, stride " << stride);
      const TestCloud<double> doubles = test::gaussian<double>(n, n);
      expect_definition<double>(Records<double>(doubles, stride).view());
    }
  }
}

TEST_P(CubeSupports, AreThoseOfTheDefinitionForEveryPositionOfABadPoint) {
  const float bad[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                       -std::numeric_limits<float>::infinity()};
  for (std::size_t n : {1, 15, 16, 33, 50}) {
    for (std::size_t i = 0; i < 3 * n; ++i) {
      TestCloud<float> cloud = test::gaussian<float>(n, 5);
      cloud.xyz[i] = bad[i % 3];
      SCOPED_TRACE(testing::Message() << n << " points, coordinate " << i);
      expect_definition<float>(Records<float>(cloud, 16).view());
      expect_definition<float>(Records<float>(cloud, 12).view());
      EXPECT_EQ(run(GetParam(), cloud.view(), SupportDirections::of(DirectionSet::dop26)).dropped, 1U);
    }
  }
}

TEST_P(CubeSupports, AreThoseOfTheDefinitionForIndexLists) {
  const TestCloud<float> cloud = test::gaussian<float>(4000, 3);
  std::vector<std::int32_t> indices(4000);
  std::iota(indices.begin(), indices.end(), 0);
  std::shuffle(indices.begin(), indices.end(), std::mt19937_64(4));
  indices.resize(2777);
  indices.push_back(3999);  // the last point of the cloud: nothing may be read behind it
  for (const std::size_t stride : {12, 16, 32, 48}) {
    const Records<float> records(cloud, stride);
    PointView view = records.view();
    view.indices = indices.data();
    view.count = indices.size();
    SCOPED_TRACE(testing::Message() << "stride " << stride);
    expect_definition<float>(view);
  }
}

TEST_P(CubeSupports, AreThoseOfTheDefinitionForGroupsAndAnySliceOfThem) {
  TestCloud<float> cloud = test::gaussian<float>(2200, 12);
  cloud.xyz[3 * 1500 + 1] = std::numeric_limits<float>::quiet_NaN();
  const TestCloud<double> doubles = test::gaussian<double>(2200, 13);
  const PointGroups groups(cloud.view(), GetParam());
  const PointGroups double_groups(doubles.view(), GetParam());
  for (const std::size_t begin : {0, 1, 7, 8, 15, 16, 17, 33, 1008, 1024, 1025}) {
    for (const std::size_t n : {0, 1, 2, 7, 8, 9, 15, 16, 17, 31, 40, 100, 1024, 1030, 1175}) {
      SCOPED_TRACE(testing::Message() << n << " points from " << begin);
      expect_definition<float>(groups.view().slice(begin, n));
      expect_definition<double>(double_groups.view().slice(begin, n));
    }
  }
}

TEST_P(CubeSupports, AreThoseOfTheDefinitionForIndexListsIntoGroups) {
  const TestCloud<float> cloud = test::gaussian<float>(500, 14);
  const PointGroups groups(cloud.view());
  const std::int32_t indices[] = {499, 3, 17, 18, 19, 20, 21, 22, 23, 0, 480, 16, 15, 64, 65, 66, 67, 68, 70};
  PointView view = groups.view();
  view.indices = indices;
  for (view.count = 0; view.count <= std::size(indices); ++view.count)
    expect_definition<float>(view);
}

TEST_P(CubeSupports, SumsAreNotContracted) {
  // x + y rounds here; with a fused multiply-add in place of the separate sum the last bit differs.
  const TestCloud<float> cloud{"fma", {1.0F + 0x1p-23F, 0x1p-24F, -1.0F, 16777216.0F, 1.0F, 1.0F}};
  expect_definition<float>(cloud.view());
  const SupportDirections& directions = SupportDirections::of(DirectionSet::dop14);
  EXPECT_EQ(run(GetParam(), cloud.view(), directions).supports[7].index, 1U);
}

TEST_P(CubeSupports, ABoxOfMixedZerosHasPositiveZeros) {
  for (const std::size_t copies : {1, 7, 100}) {
    TestCloud<float> cloud{"zeros", {}};
    for (std::size_t i = 0; i < copies; ++i)
      cloud.xyz.insert(cloud.xyz.end(), {0.0F, -0.0F, 0.0F, -0.0F, 0.0F, -0.0F, -0.0F, -0.0F, -0.0F});
    const AxisExtents box = axis_extents(GetParam(), cloud.view());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_FALSE(std::signbit(box.low[axis]));
      EXPECT_FALSE(std::signbit(box.high[axis]));
    }
  }
}

TEST_P(CubeSupports, ABoxIsRightWhateverTheSigns) {
  // Integer comparison of floats goes wrong where all signs agree, unless it is told.
  for (const double offset : {-30.0, -3.0, 0.0, 3.0, 30.0}) {
    const TestCloud<float> cloud = test::gaussian<float>(5000, 9, 1, offset);
    expect_definition<float>(cloud.view());
    expect_definition<float>(Records<float>(cloud, 16).view());
    expect_definition<float>(Records<float>(cloud, 32).view());
  }
}

TEST_P(CubeSupports, DoublesBeyondTheLimitAreDropped) {
  TestCloud<double> cloud{"limit", {1e100, 0, 0, 0, -1.01e100, 0, 1, 2, 3, 0, 0, 1e200}};
  for (int i = 0; i < 50; ++i)
    cloud.xyz.insert(cloud.xyz.end(), {0.99e100, 1, 1});
  cloud.xyz.insert(cloud.xyz.end(), {1.01e100, 1, 1});
  expect_definition<double>(cloud.view());
  EXPECT_EQ(run(GetParam(), cloud.view(), SupportDirections::of(DirectionSet::dop6)).dropped, 3U);
  EXPECT_EQ(axis_extents(GetParam(), cloud.view()).high[0], 1e100);
}

TEST_P(CubeSupports, OfPointsOnOneSideOfTheirMeanInAFlatDirection) {
  // Planes x + y = 1 near the origin and x + y = 0.5 far from it: the mean, rounded, may lie on either side
  // of them, and far from the origin so far that all points are clearly on one.
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    TestCloud<float> near = test::gaussian<float>(300, seed), far = near;
    for (std::size_t i = 0; i < near.size(); ++i) {
      near.xyz[3 * i + 1] = 1 - near.xyz[3 * i];
      far.xyz[3 * i] = 4e6F + 0.5F * std::round(2 * far.xyz[3 * i]);
      far.xyz[3 * i + 1] = 0.5F - far.xyz[3 * i];
    }
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    expect_definition<float>(near.view());
    expect_definition<float>(far.view());
  }
}

TEST_P(CubeSupports, OfAFlatChunkAreFoundWhereItsRoundedMeanLiesBeside) {
  // x + y = 2^21 for both; their mean is rounded in x alone, and then its sum is 2^-4 less. Mirrored, more.
  for (const float sign : {1.0F, -1.0F}) {
    const TestCloud<float> cloud{
        "", {sign * 0x1p20F, sign * 0x1p20F, 0, sign * (0x1p20F + 0.125F), sign * (0x1p20F - 0.125F), 0}};
    expect_definition<float>(cloud.view());
  }
}

TEST_P(CubeSupports, AreFoundUnlessTheyCannotReachWhatIsKnown) {
  // Doubles at UTM size too: there the sums along a direction are rounded to more than the points' extent
  // needs.
  const SupportDirections& directions = SupportDirections::of(DirectionSet::dop26);
  const TestCloud<float> floats = test::gaussian<float>(20'000, 11, 3, 1e3);
  test::expect_found_unless_beyond(GetParam(), floats.view(), directions);
  for (std::uint64_t seed = 12; seed < 20; ++seed) {
    const TestCloud<double> doubles = test::gaussian<double>(500, seed, 3, 5e6);
    test::expect_found_unless_beyond(GetParam(), doubles.view(), directions);
  }
}

INSTANTIATE_TEST_SUITE_P(EveryUsableSet, CubeSupports, testing::ValuesIn(usable_isas()),
                         [](const auto& param) { return std::string(isa_name(param.param)); });

}  // namespace
}  // namespace pcl_bv::detail
