// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/kernels/support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <random>

#include "clouds.h"
#include "directions.h"
#include "exact.h"
#include "pcl_bv/points/point_groups.h"
#include "pcl_bv/points/point_source.h"
#include "supports_by_definition.h"

namespace pcl_bv::detail {
namespace {

using test::by_definition;
using test::Directions;
using test::expect_same;
using test::Rational;
using test::Records;
using test::run;
using test::TestCloud;

SupportDirections set_of(const Directions& directions) {
  SupportDirections set;
  for (const Direction& d : directions)
    set.add(d);
  return set;
}

class CustomSupports : public testing::TestWithParam<Isa> {
 protected:
  void expect_definition(const PointView& points, const Directions& directions) {
    const SupportDirections set = set_of(directions);
    expect_same(run(GetParam(), points, set), by_definition(points, set), set.count);
  }

  template <typename T>
  void expect_definition_on_nasty_clouds(const Directions& directions) {
    for (const TestCloud<T>& cloud : test::nasty_clouds<T>()) {
      SCOPED_TRACE(cloud.name);
      expect_definition(cloud.view(), directions);
    }
  }
};

TEST_P(CustomSupports, AreThoseOfTheDefinitionForFloat) {
  expect_definition_on_nasty_clouds<float>(test::nasty_directions());
  expect_definition_on_nasty_clouds<float>(test::random_directions(5, 1));
  expect_definition_on_nasty_clouds<float>(test::integer_directions());
}

TEST_P(CustomSupports, AreThoseOfTheDefinitionForDouble) {
  expect_definition_on_nasty_clouds<double>(test::nasty_directions());
  expect_definition_on_nasty_clouds<double>(test::random_directions(5, 2));
}

TEST_P(CustomSupports, AreThoseOfTheDefinitionForEveryNumberOfDirections) {
  // Groups of directions, and parts of a chunk that shrink as directions grow.
  const TestCloud<float> cloud = test::gaussian<float>(kChunkPoints, 5);
  for (std::size_t n = 1; n <= kMaxSupportDirections; n += n < 10 ? 1 : 3) {
    SCOPED_TRACE(testing::Message() << n << " directions");
    expect_definition(Records<float>(cloud, 16).view(), test::random_directions(n, n));
  }
}

TEST_P(CustomSupports, AreThoseOfTheDefinitionForEveryStrideOffsetAndTail) {
  const Directions directions = test::random_directions(3, 4);
  for (std::size_t n = 1; n <= 3 * 16 + 1; ++n) {
    const TestCloud<float> cloud = test::gaussian<float>(n, n);
    for (const auto& [stride, offset] : std::vector<std::pair<std::size_t, std::size_t>>{
             {12, 0}, {16, 0}, {16, 4}, {20, 0}, {29, 13}, {31, 3}, {32, 0}, {32, 16}, {32, 20}, {48, 32}}) {
      SCOPED_TRACE(testing::Message() << n << " points, stride " << stride << ", offset " << offset);
      expect_definition(Records<float>(cloud, stride, offset).view(), directions);
    }
    for (const std::size_t stride : {24, 32, 40}) {
      SCOPED_TRACE(testing::Message() << n << " double points, stride " << stride);
      expect_definition(Records<double>(test::gaussian<double>(n, n), stride).view(), directions);
    }
  }
}

TEST_P(CustomSupports, AreThoseOfTheDefinitionForGroupsAndTheirSlices) {
  // The last packet of a block may start amid a group, where a vector of x must not end in y.
  const Directions directions = test::random_directions(3, 7);
  for (std::size_t n = 1; n <= 3 * 16 + 1; ++n) {
    const PointGroups floats(test::gaussian<float>(n, n).view());
    const PointGroups doubles(test::gaussian<double>(n, n).view());
    for (std::size_t begin = 0; begin < n; begin += 1 + n / 5) {
      SCOPED_TRACE(testing::Message() << n << " points from " << begin);
      expect_definition(floats.view().slice(begin, n - begin), directions);
      expect_definition(doubles.view().slice(begin, n - begin), directions);
    }
  }
}

TEST_P(CustomSupports, AreThoseOfTheDefinitionForEveryPositionOfABadPoint) {
  const float bad[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                       -std::numeric_limits<float>::infinity()};
  const Directions directions = test::random_directions(6, 5);
  for (std::size_t n : {1, 15, 16, 33, 50}) {
    for (std::size_t i = 0; i < 3 * n; ++i) {
      TestCloud<float> cloud = test::gaussian<float>(n, 5);
      cloud.xyz[i] = bad[i % 3];
      SCOPED_TRACE(testing::Message() << n << " points, coordinate " << i);
      expect_definition(Records<float>(cloud, 16).view(), directions);
      expect_definition(Records<float>(cloud, 12).view(), directions);
      EXPECT_EQ(run(GetParam(), cloud.view(), set_of(directions)).dropped, 1U);
    }
  }
}

TEST_P(CustomSupports, OfTheOnlyValidPointAreItsOwn) {
  const Directions directions = test::random_directions(3, 5);
  for (const std::size_t n : {1, 15, 40}) {
    for (std::size_t i = 0; i < n; ++i) {
      TestCloud<float> cloud{"", std::vector<float>(3 * n, std::numeric_limits<float>::quiet_NaN())};
      std::fill_n(&cloud.xyz[3 * i], 3, 1.5F);
      SCOPED_TRACE(testing::Message() << n << " points, valid " << i);
      expect_definition(cloud.view(), directions);
    }
  }
}

TEST_P(CustomSupports, AreThoseOfTheDefinitionForIndexListsWithRepetitions) {
  const TestCloud<float> cloud = test::gaussian<float>(4000, 3);
  std::vector<std::int32_t> indices(4000);
  std::iota(indices.begin(), indices.end(), 0);
  std::shuffle(indices.begin(), indices.end(), std::mt19937_64(4));
  indices.resize(2777);
  indices.insert(indices.end(), indices.begin(), indices.begin() + 1000);
  indices.push_back(3999);  // the last point of the cloud: nothing may be read behind it
  for (const std::size_t stride : {12, 16, 32, 48}) {
    const Records<float> records(cloud, stride);
    PointView view = records.view();
    view.indices = indices.data();
    view.count = indices.size();
    SCOPED_TRACE(testing::Message() << "stride " << stride);
    expect_definition(view, test::random_directions(7, 6));
  }
}

TEST_P(CustomSupports, AreThoseOfTheDefinitionForEveryTailOfABlock) {
  const Directions directions = {{0.3, 0.2, 0.1}, {-0.1, 0.1, 0.5}};
  for (const std::size_t whole : {64, 128, 256, 512, 1024}) {
    for (std::size_t n = whole + 1; n < whole + 18; ++n) {
      TestCloud<float> cloud = test::gaussian<float>(n, n);
      for (std::size_t i = n - 17; i < n; ++i)
        cloud.xyz[3 * i + i % 3] *= 100;  // all that matters is in the tail
      SCOPED_TRACE(testing::Message() << n << " points");
      for (const std::size_t stride : {12, 16, 32})
        expect_definition(Records<float>(cloud, stride).view(), directions);
      const TestCloud<double> doubles{"", {cloud.xyz.begin(), cloud.xyz.end()}};
      expect_definition(doubles.view(), directions);
    }
  }
}

TEST_P(CustomSupports, OfEqualPointsAreTheSmallestIndexWhateverTheOrder) {
  const std::vector<float> xyz(3 * 100, 0.7F);
  const std::vector<std::int32_t> indices = {50, 7, 99, 3, 8};
  const PointView view = PointView::of(xyz.data(), 12, indices.size(), indices.data());
  expect_definition(view, test::nasty_directions());
  EXPECT_EQ(run(GetParam(), view, set_of({{1, 2, 3}})).supports[0].index, 3U);
}

template <typename T>
TestCloud<T> flat(std::uint64_t seed, double offset) {
  TestCloud<T> cloud = test::gaussian<T>(9000, seed, 20, offset);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    cloud.xyz[3 * i + 2] = cloud.xyz[3 * i] / 3 + cloud.xyz[3 * i + 1];
  return cloud;
}

TEST_P(CustomSupports, OfPointsFlatInTheDirectionAreDecidedExactly) {
  // Planes far from the origin and near: every point is within the filter's band, the last bits decide.
  const Directions directions = {{1.0 / 3, 1, -1}, {-1.0 / 3, -1, 1}, {0.1 / 3, 0.1, -0.1}};
  for (const double offset : {0.0, 5e6}) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      SCOPED_TRACE(testing::Message() << "offset " << offset << ", seed " << seed);
      expect_definition(flat<float>(seed, offset).view(), directions);
      expect_definition(flat<double>(seed, offset).view(), directions);
    }
  }
}

TEST_P(CustomSupports, AreRightWherePartialSumsOverflow) {
  // 1.9 x is -infinity in float; 1.9 (x + y) is the greatest projection.
  TestCloud<float> cloud = test::gaussian<float>(200, 2, 1e36);
  cloud.xyz.insert(cloud.xyz.begin() + 3 * 30, {-2e38F, 2.2e38F, 1e36F});
  cloud.xyz.insert(cloud.xyz.begin() + 3 * 60, {2.1e38F, -2.4e38F, 1e36F});
  expect_definition(cloud.view(), {{1.9, 1.9, 1.9}});
  const ChunkSupports farthest = run(GetParam(), cloud.view(), set_of({{1.9, 1.9, 1.9}}));
  EXPECT_EQ(farthest.supports[0].index, 60U);
  EXPECT_EQ(farthest.supports[1].index, 30U);
}

template <typename T>
TestCloud<T> circle_across(std::size_t axis) {
  TestCloud<T> cloud{"circle", std::vector<T>(3 * 3000)};
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    cloud.xyz[3 * i + (axis + 1) % 3] = static_cast<T>(1e30 * std::cos(i));
    cloud.xyz[3 * i + (axis + 2) % 3] = static_cast<T>(1e30 * std::sin(i));
  }
  return cloud;
}

template <typename T>
TestCloud<T> line_along(std::size_t axis) {
  TestCloud<T> cloud{"line", std::vector<T>(3 * 3000)};
  for (std::size_t i = 0; i < cloud.size(); ++i)
    cloud.xyz[3 * i + axis] = static_cast<T>(1e30 * std::cos(i));
  return cloud;
}

// By that many axes: x becomes y, y becomes z, z becomes x if by one.
Direction turned(const Direction& d, std::size_t by) {
  return {d[(3 - by) % 3], d[(4 - by) % 3], d[(5 - by) % 3]};
}

constexpr Direction kTinyComponents[] = {
    {1, 1e-42, 3e-43},      {1, 1e-44, 1.2e-44},      {1, 1e-46, 3e-46},      {1, 7e-319, 2e-318},
    {1e30, 1e-288, 3e-289}, {1e30, 1e-293, 1.3e-293}, {1e30, 1e-305, -2e-306}};

TEST_P(CustomSupports, AreRightWhereOnlyTinyComponentsOfTheDirectionMatter) {
  // As floats the components keep a few bits or none, as scaled doubles too: the rounded ones point
  // elsewhere.
  for (const Direction& tiny : kTinyComponents) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Direction n = turned(tiny, axis);
      SCOPED_TRACE(testing::Message() << n[0] << ' ' << n[1] << ' ' << n[2]);
      expect_definition(circle_across<float>(axis).view(), {n});
      expect_definition(circle_across<double>(axis).view(), {n});
      for (std::size_t other = 1; other < 3; ++other) {
        expect_definition(line_along<float>((axis + other) % 3).view(), {n});
        expect_definition(line_along<double>((axis + other) % 3).view(), {n});
      }
    }
  }
}

TEST(SupportDirections, WhatIsSurelyReachedIsReachedInExactArithmetic) {
  Directions directions = test::nasty_directions();
  directions.insert(directions.end(), std::begin(kTinyComponents), std::end(kTinyComponents));
  std::mt19937_64 random(21);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (std::size_t by = 0; by < 3; ++by) {
    for (const Direction& d : directions) {
      const Direction direction = turned(d, by);
      const SupportDirections set = set_of({direction});
      const double greatest = std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])});
      const Rational scale(std::ldexp(1, -std::ilogb(greatest)));
      for (int i = 0; i < 2000; ++i) {
        // Magnitudes from 1e-300 to 1e100, alike or not; and zeros, so that tiny products decide.
        const double size = std::pow(10, 200 * unit(random) - 100);
        double p[3];
        for (double& c : p)
          c = random() % 3 == 0 ? 0 : size * unit(random) * (random() % 4 == 0 ? 1e-20 : 1);
        const Coordinates point = {p[0], p[1], p[2]};
        const Rational exact = test::exact_dot(direction, point) * scale;
        ASSERT_TRUE(Rational(projection_lower_bound(set, 1, point)) <= exact)
            << "seed 21, " << i << ", along " << by;
        ASSERT_TRUE(Rational(projection_lower_bound(set, 0, point)) <= -exact)
            << "seed 21, " << i << ", along " << by;
      }
    }
  }
}
TEST_P(CustomSupports, DoublesBeyondTheLimitAreDropped) {
  TestCloud<double> cloud{"limit", {1e100, 0, 0, 0, -1.01e100, 0, 1, 2, 3, 0, 0, 1e200}};
  for (int i = 0; i < 50; ++i)
    cloud.xyz.insert(cloud.xyz.end(), {0.99e100, 1, 1});
  cloud.xyz.insert(cloud.xyz.end(), {1.01e100, 1, 1});
  expect_definition(cloud.view(), test::nasty_directions());
  EXPECT_EQ(run(GetParam(), cloud.view(), set_of({{1, 1, 1}})).dropped, 3U);
}

TEST_P(CustomSupports, DoublesHardlyBeyondTheLimitAreDroppedAlsoNearTheCentre) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      SCOPED_TRACE(testing::Message() << "axis " << axis << ", sign " << sign);
      TestCloud<double> cloud{"limit", std::vector<double>(3 * 60, 1)};
      for (std::size_t i = 0; i < cloud.size(); ++i)
        cloud.xyz[3 * i + axis] = sign * (i == 7 ? 1.01e100 : 0.99e100);
      expect_definition(cloud.view(), test::nasty_directions());
    }
  }
}

TEST_P(CustomSupports, OfDoublesAreRightWhereProductsVanish) {
  for (const double scale : {1e-300, 1e-310, 1e-322, 1e-160, 1e95}) {
    SCOPED_TRACE(testing::Message() << "scale " << scale);
    TestCloud<double> cloud = test::gaussian<double>(1500, 3);
    for (double& c : cloud.xyz)
      c *= scale;
    expect_definition(cloud.view(), test::nasty_directions());
  }
}

TEST_P(CustomSupports, AreFoundUnlessTheyCannotReachWhatIsKnown) {
  const TestCloud<float> cloud = test::gaussian<float>(20'000, 11, 3, 1e3);
  const SupportDirections set = set_of(test::random_directions(13, 8));
  test::expect_found_unless_beyond(GetParam(), cloud.view(), set);
}

INSTANTIATE_TEST_SUITE_P(EveryUsableSet, CustomSupports, testing::ValuesIn(usable_isas()),
                         [](const auto& param) { return std::string(isa_name(param.param)); });

}  // namespace
}  // namespace pcl_bv::detail
