// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/kernels/moments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "clouds.h"
#include "exact.h"
#include "pcl_bv/points/point_groups.h"
#include "pcl_bv/points/point_source.h"

namespace pcl_bv::detail {
namespace {

using test::Rational;
using test::Records;
using test::TestCloud;

// As the header defines them, from loads to lanes; `term` is one of x y z xx xy xz yy yz zz.
double by_definition(const PointView& points, const Moments& about, std::size_t term) {
  double total = 0;
  for (std::size_t lane = 0; lane < 8; ++lane) {
    double sum = 0;
    for (std::size_t i = lane; i < points.count; i += 8) {
      const Coordinates p = load_point(points, i);
      if (!is_valid(p)) continue;
      const Coordinates& o = about.origin;
      const double v[3] = {std::ldexp(p.x - o.x, about.exponent), std::ldexp(p.y - o.y, about.exponent),
                           std::ldexp(p.z - o.z, about.exponent)};
      constexpr std::size_t a[] = {0, 1, 2, 0, 0, 0, 1, 1, 2};
      constexpr std::size_t b[] = {0, 0, 0, 0, 1, 2, 1, 2, 2};
      const volatile double value = term < 3 ? v[a[term]] : v[a[term]] * v[b[term]];
      sum += value;
    }
    total += sum;
  }
  return total;
}

double squares_by_definition(const PointView& points, Moments about, int exponent) {
  about.exponent = exponent;
  return by_definition(points, about, 3) + by_definition(points, about, 6) + by_definition(points, about, 8);
}

class MomentsTest : public testing::TestWithParam<Isa> {
 protected:
  void expect_definition(const PointView& points) {
    for (std::size_t begin = 0; begin < points.count; begin += kBlockPoints)
      expect_definition_of_block(points.slice(begin, std::min(kBlockPoints, points.count - begin)));
  }

  void expect_offsets(const PointView& points, const Moments& moments) {
    BlockOffsets offsets;
    std::fill_n(offsets.x, kBlockPoints, 7);  // each stored offset must overwrite it
    std::fill_n(offsets.y, kBlockPoints, 7);
    std::fill_n(offsets.z, kBlockPoints, 7);
    const Moments again = block_moments(GetParam(), points, offsets);
    EXPECT_EQ(again.count, moments.count);
    EXPECT_EQ(again.exponent, moments.exponent);
    EXPECT_TRUE(again.sum == moments.sum && again.product == moments.product);
    ASSERT_EQ(offsets.count, moments.count == 0 ? 0 : (points.count + 7) / 8 * 8);
    for (std::size_t i = 0; i < offsets.count; ++i) {
      const Coordinates p = i < points.count ? load_point(points, i) : moments.origin;
      const Coordinates q = is_valid(p) ? p : moments.origin;
      const Coordinates& o = moments.origin;
      const double expected[] = {q.x - o.x, q.y - o.y, q.z - o.z};
      const double found[] = {offsets.x[i], offsets.y[i], offsets.z[i]};
      EXPECT_EQ(std::memcmp(found, expected, sizeof found), 0) << "point " << i;
    }
  }

  void expect_definition_of_block(const PointView& points) {
    const Moments moments = block_moments(GetParam(), points);
    expect_offsets(points, moments);
    std::vector<Coordinates> valid;
    for (std::size_t i = 0; i < points.count; ++i) {
      if (is_valid(load_point(points, i))) valid.push_back(load_point(points, i));
    }
    ASSERT_EQ(moments.count, valid.size());
    EXPECT_TRUE(valid.empty() || moments.origin == valid[0]);
    for (std::size_t term = 0; term < 9; ++term) {
      const double found = term < 3 ? moments.sum[term] : moments.product[term - 3];
      const double expected = by_definition(points, moments, term);
      EXPECT_EQ(std::memcmp(&found, &expected, sizeof found), 0)
          << "term " << term << ": " << found << " and " << expected;
    }
    if (points.scalar == ScalarType::float32 || valid.empty()) {
      EXPECT_EQ(moments.exponent, 0);
      return;
    }
    EXPECT_TRUE(moments.exponent == 1000 ||
                squares_by_definition(points, moments, moments.exponent) >= 0x1p-660);
    for (int exponent = 0; exponent < moments.exponent; exponent += 500)
      EXPECT_LT(squares_by_definition(points, moments, exponent), 0x1p-660);
  }
};

TEST_P(MomentsTest, HaveTheBitsOfTheDefinitionOnNastyClouds) {
  for (const TestCloud<float>& cloud : test::nasty_clouds<float>()) {
    SCOPED_TRACE(cloud.name);
    expect_definition(cloud.view());
  }
  for (const TestCloud<double>& cloud : test::nasty_clouds<double>()) {
    SCOPED_TRACE(cloud.name);
    expect_definition(cloud.view());
  }
}

TEST_P(MomentsTest, HaveTheBitsOfTheDefinitionForEveryLayoutTailAndBadPoint) {
  for (std::size_t n = 1; n <= 3 * 16 + 1; ++n) {
    TestCloud<float> cloud = test::gaussian<float>(n, n);
    TestCloud<double> doubles = test::gaussian<double>(n, n);
    for (const bool bad : {false, true}) {
      if (bad) cloud.xyz[n * 7 % (3 * n)] = std::numeric_limits<float>::quiet_NaN();
      if (bad) doubles.xyz[n * 7 % (3 * n)] = -1.1e100;
      for (const std::size_t stride : {12, 16, 20, 32, 48}) {
        SCOPED_TRACE(testing::Message() << n << " points, stride " << stride << ", bad " << bad);
        expect_definition(Records<float>(cloud, stride).view());
      }
      expect_definition(Records<float>(cloud, 31, 13).view());
      for (const std::size_t stride : {24, 32, 40})
        expect_definition(Records<double>(doubles, stride).view());
      const PointGroups groups(cloud.view());
      for (const std::size_t begin : {std::size_t{0}, n / 3, n - 1})
        expect_definition(groups.view().slice(begin, n - begin));
    }
  }
}

TEST_P(MomentsTest, HaveTheBitsOfTheDefinitionForIndexListsAndWholeChunks) {
  const TestCloud<float> cloud = test::gaussian<float>(kChunkPoints, 3, 20, 5e6);
  expect_definition(cloud.view());
  std::vector<std::int32_t> indices(kChunkPoints);
  std::iota(indices.begin(), indices.end(), 0);
  std::shuffle(indices.begin(), indices.end(), std::mt19937_64(4));
  PointView view = cloud.view();
  view.indices = indices.data();
  expect_definition(view);
}

TEST_P(MomentsTest, ProductsAreRoundedBeforeTheyAreAdded) {
  // In one lane: -(1 + 2^-29), then the square of 1 + 2^-30, whose last term, 2^-60, a fused sum would keep.
  // The first point is the origin.
  TestCloud<double> cloud{"fma", std::vector<double>(3 * 10, 0.0)};
  cloud.xyz[3] = -(1 + 0x1p-29);
  cloud.xyz[4] = 1;
  cloud.xyz[3 * 9] = cloud.xyz[3 * 9 + 1] = 1 + 0x1p-30;
  EXPECT_EQ(block_moments(GetParam(), cloud.view()).product[1], 0.0);
}

TEST_P(MomentsTest, AreWithinTheStatedBoundOfTheExactSums) {
  for (const double offset : {0.0, 5e6}) {
    const TestCloud<float> cloud = test::gaussian<float>(kBlockPoints, 5, 20, offset);
    const Coordinates origin = load_point(cloud.view(), 0);
    const Moments moments = block_moments(GetParam(), cloud.view());
    Rational x = 0, xy = 0, x_magnitude = 0, xy_magnitude = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Coordinates p = load_point(cloud.view(), i);
      const Rational dx = Rational(p.x) - Rational(origin.x);
      const Rational product = dx * (Rational(p.y) - Rational(origin.y));
      x += dx;
      xy += product;
      x_magnitude += abs(dx);
      xy_magnitude += abs(product);
    }
    EXPECT_LE(abs(Rational(moments.sum[0]) - x), Rational(140 * 0x1p-53) * x_magnitude);
    EXPECT_LE(abs(Rational(moments.product[1]) - xy), Rational(140 * 0x1p-53) * xy_magnitude);
  }
}

TEST_P(MomentsTest, OfDoublesWhoseSquaresVanishAreScaledByTheLeastPowerThatHelps) {
  for (const auto& [scale, exponent] : {std::pair{1.0, 0},
                                        {1e-90, 0},
                                        {1e-110, 500},
                                        {1e-240, 500},
                                        {1e-260, 1000},
                                        {1e-320, 1000},
                                        {0.0, 1000}}) {
    const TestCloud<double> cloud = test::gaussian<double>(100, 6, scale);
    SCOPED_TRACE(cloud.name);
    EXPECT_EQ(block_moments(GetParam(), cloud.view()).exponent, exponent);
    expect_definition(cloud.view());
  }
}

INSTANTIATE_TEST_SUITE_P(EveryUsableSet, MomentsTest, testing::ValuesIn(usable_isas()),
                         [](const auto& param) { return std::string(isa_name(param.param)); });

}  // namespace
}  // namespace pcl_bv::detail
