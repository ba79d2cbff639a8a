// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The ground plane where there is hardly one: tiny, degenerate, invalid, huge and denormal clouds, bad
// settings.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

#include "allocations.h"
#include "flush_to_zero.h"
#include "ground_scenes.h"

namespace pcl_bv::detail {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(GroundPlaneAtTheLimits, SmallCloudsHaveOneWhenTheySpanATriangle) {
  EXPECT_FALSE(split(Cloud<float>{}).found);
  for (const Cloud<float>& cloud :
       {Cloud<float>{{1, 2, 3}}, Cloud<float>{{1, 2, 3}, {4, 5, 3}}, Cloud<float>(1000, {1, 2, 3}),
        Cloud<float>{{0, 0, 0}, {1, 1, 0}, {2, 2, 0}, {5, 5, 0}}}) {
    const GroundSplit result = split(cloud);
    EXPECT_FALSE(result.found);
    EXPECT_EQ(result.normal, Eigen::Vector3d::Zero());
    EXPECT_EQ(result.offset, 0);
    EXPECT_THAT(result.ground, IsEmpty());
    EXPECT_EQ(result.rest, numbers(0, cloud.size()));
  }
  const GroundSplit triangle = split(Cloud<float>{{0, 0, 2}, {1, 0, 2}, {0, 1, 2}});
  EXPECT_TRUE(triangle.found);
  EXPECT_EQ(triangle.normal, Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(triangle.offset, 2);
  EXPECT_THAT(triangle.ground, ElementsAre(0, 1, 2));
}

TEST(GroundPlaneAtTheLimits, AWallIsNone) {
  for (std::uint32_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(0, 1);
    Cloud<float> cloud;
    for (int i = 0; i < 3000; ++i)
      cloud.push_back({10 + 0.05F * uniform(random), 10 * uniform(random), 3 * uniform(random)});
    EXPECT_FALSE(split(cloud).found);
  }
}

TEST(GroundPlaneAtTheLimits, AScanLineIsNone) {
  for (std::uint32_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(0, 1);
    Cloud<float> cloud;
    for (int i = 0; i < 3000; ++i)
      cloud.push_back({10 + 0.05F * uniform(random), 20 * uniform(random), 0.05F * uniform(random)});
    EXPECT_FALSE(split(cloud).found);
  }
}

TEST(GroundPlaneAtTheLimits, DropsInvalidPointsAndKeepsTheOrderOfTheView) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const Cloud<float> cloud{{0, 0, 0}, {nan, 0, 0}, {4, 0, 0},   {0, 4, infinity}, {0, 4, 0},
                           {4, 4, 5}, {4, 4, 0},   {1, 1, nan}, {9, 9, 9}};
  const std::array<std::int32_t, 10> indices{6, 5, 4, 3, 2, 1, 0, 7, 5, 4};
  PointView some = scene_view(cloud);
  some.indices = indices.data();
  some.count = indices.size();
  GroundSplit result;
  split_ground(some, {}, result);
  EXPECT_TRUE(result.found);
  EXPECT_THAT(result.ground, ElementsAre(6, 4, 2, 0, 4));
  EXPECT_THAT(result.rest, ElementsAre(5, 5));
  split_ground(scene_view(cloud).slice(2, 5), {}, result);
  EXPECT_THAT(result.ground, ElementsAre(2, 4, 6));
  EXPECT_THAT(result.rest, ElementsAre(5));
  split_ground(scene_view(Cloud<float>(100, {nan, nan, nan})), {}, result);
  EXPECT_FALSE(result.found);
  EXPECT_THAT(result.rest, IsEmpty());
}

TEST(GroundPlaneAtTheLimits, StrayPointsAndDeadBeamsDoNotMoveIt) {
  Cloud<float> cloud;
  add_plane<float>(cloud, 4000, 20, 0, 0, -1.7F, 0.03F, 0.02F);
  cloud.insert(cloud.end(), 9000, {0, 0, 0});
  for (int i = 0; i < 40; ++i) {
    cloud.push_back({1e38F, -1e38F, 1e38F});
    cloud.push_back({-3e6F, 2e7F, 1e5F + static_cast<float>(i)});
  }
  const GroundSplit result = split(cloud);
  ASSERT_TRUE(result.found);
  EXPECT_NEAR(result.offset / result.normal.z(), -1.7, 0.01);
  EXPECT_EQ(result.ground, numbers(0, 4000));
}

TEST(GroundPlaneAtTheLimits, HoldsInUtmCoordinates) {
  Cloud<float> cloud;  // floats are 0.5 m apart at 5e6
  for (int x = -40; x < 40; ++x) {
    for (int y = -40; y < 40; ++y) {
      cloud.push_back({4e5F + 0.5F * static_cast<float>(x), 5e6F + 0.5F * static_cast<float>(y),
                       310 + 0.0625F * static_cast<float>(x)});
    }
  }
  const std::size_t ground = cloud.size();
  for (std::size_t i = 0; i < ground; i += 7)
    cloud.push_back({cloud[i][0], cloud[i][1], cloud[i][2] + 0.5F});
  const GroundSplit result = split(cloud);
  ASSERT_TRUE(result.found);
  EXPECT_EQ(result.ground, numbers(0, ground));
  EXPECT_NEAR(-result.normal.x() / result.normal.z(), 0.125, 1e-9);
}

TEST(GroundPlaneAtTheLimits, HasTheSameBitsWhereverThePointsLie) {
  Cloud<double> cloud;
  std::mt19937 random(4);
  for (int i = 0; i < 3000; ++i)
    cloud.push_back({double(random() % 1000) / 64, double(random() % 1000) / 64, double(random() % 8) / 64});
  const GroundSplit expected = split(cloud);
  ASSERT_TRUE(expected.found);
  for (const std::size_t axis : {0U, 1U, 2U}) {
    Cloud<double> moved = cloud;
    for (auto& p : moved)
      p[axis] += 0x1p40;
    EXPECT_EQ(split(moved).normal, expected.normal) << axis;
  }
}

TEST(GroundPlaneAtTheLimits, EachPointOfFewCountsOnce) {
  // A saddle: level by symmetry.
  const GroundSplit result = split(Cloud<double>{{1, 0, 0.01}, {0, 1, -0.01}, {-1, 0, 0.01}, {0, -1, -0.01}});
  ASSERT_TRUE(result.found);
  EXPECT_NEAR(result.offset, 0, 1e-15);
  EXPECT_NEAR(result.normal.z(), 1, 1e-15);
}

TEST(GroundPlaneAtTheLimits, ScalesExactlyByPowersOfTwo) {
  Cloud<float> cloud;
  std::mt19937 random(3);
  for (int i = 0; i < 3000; ++i) {
    const float height = i % 3 == 0 ? static_cast<float>(random() % 4000) : static_cast<float>(random() % 8);
    cloud.push_back({static_cast<float>(random() % 10'000), static_cast<float>(random() % 10'000), height});
  }
  GroundPlaneOptions settings;
  settings.distance = 30;
  const GroundSplit expected = split(cloud, settings);
  ASSERT_TRUE(expected.found);
  for (const int exponent :
       {-149, -60, 20, 100}) {  // the first makes the coordinates denormal, 1e-41 at most
    SCOPED_TRACE(exponent);
    Cloud<float> scaled;
    for (const auto& p : cloud)
      scaled.push_back({std::ldexp(p[0], exponent), std::ldexp(p[1], exponent), std::ldexp(p[2], exponent)});
    GroundPlaneOptions scaled_settings = settings;
    scaled_settings.distance = std::ldexp(settings.distance, exponent);
    const test::FlushToZero host;
    const GroundSplit result = split(scaled, scaled_settings);
    EXPECT_EQ(result.ground, expected.ground);
    EXPECT_EQ(result.rest, expected.rest);
    EXPECT_NEAR((result.normal - expected.normal).norm(), 0, 1e-12);
  }
}

TEST(GroundPlaneAtTheLimits, ASecondCallOfTheSameSizeAllocatesNothing) {
  Cloud<float> cloud;
  add_plane<float>(cloud, 50'000, 20, 0, 0, 0, 0, 0.1F);
  GroundSplit result;
  split_ground(scene_view(cloud), {}, result);
  for (auto& p : cloud)
    p[2] += 1;
  const std::size_t before = allocations();
  split_ground(scene_view(cloud), {}, result);
  EXPECT_EQ(allocations(), before);
  EXPECT_NEAR(result.offset, 1, 0.05);
}

TEST(GroundPlaneAtTheLimits, BadSettingsAreNamedWithTheirRange) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto complaint = [](const GroundPlaneOptions& settings) -> std::string {
    try {
      split(Cloud<float>{}, settings);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "none";
  };
  for (const double bad : {0.0, -1.0, nan, infinity}) {
    GroundPlaneOptions settings;
    settings.distance = bad;
    EXPECT_THAT(complaint(settings), HasSubstr("distance is " + std::to_string(bad) + ", must be finite"));
  }
  for (const double bad : {-0.1, 89.5, nan}) {
    GroundPlaneOptions settings;
    settings.max_slope_degrees = bad;
    EXPECT_THAT(complaint(settings),
                HasSubstr("max_slope_degrees is " + std::to_string(bad) + ", must be 0"));
  }
  for (const double bad : {-0.1, nan, infinity}) {
    GroundPlaneOptions settings;
    settings.sensor_height = bad;
    EXPECT_THAT(complaint(settings), HasSubstr("sensor_height is " + std::to_string(bad) + ", must be"));
  }
  for (const unsigned bad : {0U, 1'000'001U}) {
    GroundPlaneOptions settings;
    settings.iterations = bad;
    EXPECT_THAT(complaint(settings), HasSubstr("iterations is " + std::to_string(bad)));
  }
  EXPECT_EQ(complaint({}), "none");
}

TEST(GroundPlaneAtTheLimits, PointNumbersBeyondAnIndexAreRefused) {
  const Cloud<float> cloud(2, {1, 2, 3});
  PointView last = scene_view(cloud);
  GroundSplit result;
  last.first = (std::size_t{1} << 31) - 2;
  split_ground(last, {}, result);
  EXPECT_THAT(result.rest, ElementsAre(2147483646, 2147483647));
  ++last.first;
  EXPECT_THROW(split_ground(last, {}, result), std::length_error);
}

}  // namespace
}  // namespace pcl_bv::detail
