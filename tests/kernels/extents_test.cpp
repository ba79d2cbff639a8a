// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/kernels/extents.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <numeric>

#include "clouds.h"

namespace pcl_bv {
namespace {

using test::Records;
using test::TestCloud;

constexpr DirectionSet kSets[] = {DirectionSet::dop6, DirectionSet::dop14, DirectionSet::dop18,
                                  DirectionSet::dop26};

std::vector<BlockExtents> run(Isa isa, const PointView& points, DirectionSet set) {
  std::vector<BlockExtents> blocks(block_count(points.count));
  block_extents(isa, points, set, blocks.data());
  return blocks;
}

// Bits, not values: -0 differs from 0.
void expect_same_bits(const std::vector<BlockExtents>& a, const std::vector<BlockExtents>& b,
                      DirectionSet set) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].dropped, b[i].dropped) << "block " << i;
    for (std::size_t k = 0; k < direction_count(set); ++k) {
      EXPECT_EQ(std::memcmp(&a[i].low[k], &b[i].low[k], sizeof(double)), 0)
          << "block " << i << " direction " << k << ": " << a[i].low[k] << " and " << b[i].low[k];
      EXPECT_EQ(std::memcmp(&a[i].high[k], &b[i].high[k], sizeof(double)), 0)
          << "block " << i << " direction " << k << ": " << a[i].high[k] << " and " << b[i].high[k];
    }
  }
}

// As simple as can be: the table of directions, one multiplication at a time.
template <typename T>
std::vector<BlockExtents> by_definition(const PointView& points, DirectionSet set) {
  std::vector<BlockExtents> blocks(block_count(points.count));
  for (std::size_t i = 0; i < points.count; ++i) {
    BlockExtents& block = blocks[i / kBlockPoints];
    if (i % kBlockPoints == 0) {
      block.low.fill(std::numeric_limits<double>::infinity());
      block.high.fill(-std::numeric_limits<double>::infinity());
      block.dropped = 0;
    }
    const Coordinates p = load_point(points, i);
    if (!is_valid(p)) {
      ++block.dropped;
      continue;
    }
    for (std::size_t k = 0; k < direction_count(set); ++k) {
      const auto& d = kCubeDirections[cube_direction(set, k)];
      const T xy = static_cast<T>(static_cast<T>(d[0] * p.x) + static_cast<T>(d[1] * p.y));
      const double projection = static_cast<T>(xy + static_cast<T>(d[2] * p.z));
      block.low[k] = std::min(block.low[k], projection) + 0.0;
      block.high[k] = std::max(block.high[k], projection) + 0.0;
    }
  }
  return blocks;
}

template <typename T>
void expect_reference_follows_definition() {
  for (const TestCloud<T>& cloud : test::nasty_clouds<T>()) {
    for (const DirectionSet set : kSets) {
      SCOPED_TRACE(cloud.name + " directions " + std::to_string(direction_count(set)));
      expect_same_bits(run(Isa::scalar, cloud.view(), set), by_definition<T>(cloud.view(), set), set);
    }
  }
}

TEST(ExtentsReference, FollowsTheDefinitionForFloat) {
  expect_reference_follows_definition<float>();
}
TEST(ExtentsReference, FollowsTheDefinitionForDouble) {
  expect_reference_follows_definition<double>();
}

class Parity : public testing::TestWithParam<Isa> {
 protected:
  template <typename T>
  void expect_parity(const PointView& points) {
    for (const DirectionSet set : kSets) {
      SCOPED_TRACE("directions " + std::to_string(direction_count(set)));
      expect_same_bits(run(GetParam(), points, set), run(Isa::scalar, points, set), set);
    }
  }
};

TEST_P(Parity, ExtentsEqualReferenceBitForBitForFloat) {
  for (const TestCloud<float>& cloud : test::nasty_clouds<float>()) {
    SCOPED_TRACE(cloud.name);
    expect_parity<float>(cloud.view());
  }
}

TEST_P(Parity, ExtentsEqualReferenceBitForBitForDouble) {
  for (const TestCloud<double>& cloud : test::nasty_clouds<double>()) {
    SCOPED_TRACE(cloud.name);
    expect_parity<double>(cloud.view());
  }
}

TEST_P(Parity, ExtentsEqualReferenceForEveryStrideOffsetAndTail) {
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
      expect_parity<float>(Records<float>(cloud, stride, offset).view());
    }
    for (const std::size_t stride : {24, 32, 40}) {
      SCOPED_TRACE(testing::Message() << n << " double points, stride " << stride);
      const TestCloud<double> doubles = test::gaussian<double>(n, n);
      expect_parity<double>(Records<double>(doubles, stride).view());
    }
  }
}

TEST_P(Parity, ExtentsEqualReferenceForEveryPositionOfABadPoint) {
  const float bad[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                       -std::numeric_limits<float>::infinity()};
  for (std::size_t n : {1, 15, 16, 33, 50}) {
    for (std::size_t i = 0; i < 3 * n; ++i) {
      TestCloud<float> cloud = test::gaussian<float>(n, 5);
      cloud.xyz[i] = bad[i % 3];
      SCOPED_TRACE(testing::Message() << n << " points, coordinate " << i);
      expect_parity<float>(Records<float>(cloud, 16).view());
      expect_parity<float>(Records<float>(cloud, 12).view());
      const std::vector<BlockExtents> blocks = run(GetParam(), cloud.view(), DirectionSet::dop26);
      EXPECT_EQ(blocks[0].dropped, 1U);
    }
  }
}

TEST_P(Parity, ExtentsEqualReferenceForIndexLists) {
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
    expect_parity<float>(view);
  }
}

TEST_P(Parity, SumsAreNotContracted) {
  // x + y rounds here; with a fused multiply-add in place of the separate sum the last bit differs.
  const TestCloud<float> cloud{"fma", {1.0F + 0x1p-23F, 0x1p-24F, -1.0F, 16777216.0F, 1.0F, 1.0F}};
  expect_parity<float>(cloud.view());
  const std::vector<BlockExtents> blocks = run(GetParam(), cloud.view(), DirectionSet::dop14);
  EXPECT_EQ(blocks[0].high[3], 16777216.0F + 1.0F + 1.0F);
}

TEST_P(Parity, ABoxOfMixedZerosHasPositiveZeros) {
  const TestCloud<float> cloud{"zeros", {0.0F, -0.0F, 0.0F, -0.0F, 0.0F, -0.0F, -0.0F, -0.0F, -0.0F}};
  const std::vector<BlockExtents> blocks = run(GetParam(), cloud.view(), DirectionSet::dop6);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_FALSE(std::signbit(blocks[0].low[axis]));
    EXPECT_FALSE(std::signbit(blocks[0].high[axis]));
  }
}

TEST_P(Parity, DoublesBeyondTheLimitAreDropped) {
  const TestCloud<double> cloud{"limit", {1e100, 0, 0, 0, -1.01e100, 0, 1, 2, 3, 0, 0, 1e200}};
  const std::vector<BlockExtents> blocks = run(GetParam(), cloud.view(), DirectionSet::dop6);
  EXPECT_EQ(blocks[0].dropped, 2U);
  EXPECT_EQ(blocks[0].high[0], 1e100);
  EXPECT_EQ(blocks[0].low[1], 0.0);
}

INSTANTIATE_TEST_SUITE_P(EveryUsableSet, Parity, testing::ValuesIn(usable_isas()),
                         [](const auto& param) { return std::string(isa_name(param.param)); });

}  // namespace
}  // namespace pcl_bv
