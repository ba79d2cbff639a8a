// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The ground plane on scenes whose ground is known by construction.
#include "pcl_bv/segmentation/ground.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "ground_scenes.h"

namespace pcl_bv::detail {
namespace {

double slope_degrees(const GroundSplit& result) {
  return std::acos(result.normal.z()) * 180 / std::numbers::pi;
}

TEST(GroundPlane, SettingsAreThoseOfTheDocumentationAtFirst) {
  const GroundPlaneOptions settings;
  EXPECT_EQ(settings.up, Eigen::Vector3d::UnitZ());
  EXPECT_EQ(settings.distance, 0.2);
  EXPECT_EQ(settings.max_slope_degrees, 15);
  EXPECT_FALSE(settings.sensor_height);
  EXPECT_EQ(settings.seed, 1U);
  EXPECT_EQ(settings.iterations, 1000U);
  EXPECT_FALSE(GroundSplit().found);
  EXPECT_EQ(GroundSplit().offset, 0);
}

TEST(GroundPlane, SplitsAFloorFromWhatStandsOnIt) {
  Cloud<float> cloud;
  add_plane<float>(cloud, 3000, 10, 0, 0, -1.5F, 0.1F, 0.02F);
  const std::size_t floor = cloud.size();
  add_plane<float>(cloud, 500, 0.4F, 3, 2, 0);
  const GroundSplit result = split(cloud);
  ASSERT_TRUE(result.found);
  EXPECT_EQ(result.ground, numbers(0, floor));
  EXPECT_EQ(result.rest, numbers(floor, cloud.size()));
  EXPECT_NEAR(result.normal.norm(), 1, 1e-12);
  EXPECT_NEAR(-result.normal.x() / result.normal.z(), 0.1, 1e-3);
  EXPECT_NEAR(result.offset / result.normal.z(), -1.5, 5e-3);
}

TEST(GroundPlane, IsExactOnAnExactPlane) {
  Cloud<double> cloud;
  add_plane<double>(cloud, 2000, 50, 7, -3, -2, 0.2);
  const GroundSplit result = split(cloud);
  ASSERT_TRUE(result.found);
  for (const auto& p : cloud)
    EXPECT_NEAR(result.normal.dot(Eigen::Vector3d(p[0], p[1], p[2])), result.offset, 1e-12);
}

TEST(GroundPlane, EveryPointObeysThePublishedExpression) {
  Cloud<float> cloud;
  add_plane<float>(cloud, 5000, 20, 0, 0, 0, 0, 0.4F);  // noise over the threshold
  const GroundPlaneOptions settings;
  const GroundSplit result = split(cloud, settings);
  ASSERT_TRUE(result.found);
  ASSERT_FALSE(result.rest.empty());
  GroundSplit expected;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double x = cloud[i][0], y = cloud[i][1], z = cloud[i][2];
    const double h = (result.normal.x() * x + result.normal.y() * y) + result.normal.z() * z - result.offset;
    (h <= settings.distance ? expected.ground : expected.rest).push_back(static_cast<std::int32_t>(i));
  }
  EXPECT_EQ(result.ground, expected.ground);
  EXPECT_EQ(result.rest, expected.rest);
}

TEST(GroundPlane, KeepsTheSlopeLimit) {
  for (const double degrees : {0.0, 5.0, 14.0, 16.0, 30.0, 60.0, 89.0}) {
    SCOPED_TRACE(degrees);
    Cloud<double> cloud;
    add_plane<double>(cloud, 2000, 10, 0, 0, -1, std::tan(degrees * std::numbers::pi / 180));
    const GroundSplit result = split(cloud);
    EXPECT_EQ(result.found, degrees < 15);
    EXPECT_EQ(result.rest.size(), degrees < 15 ? 0 : cloud.size());
    if (degrees < 15) {
      EXPECT_NEAR(slope_degrees(result), degrees, 1e-5);
    }
  }
  Cloud<double> steep;
  add_plane<double>(steep, 2000, 10, 0, 0, -1, std::tan(40 * std::numbers::pi / 180));
  GroundPlaneOptions settings;
  settings.max_slope_degrees = 45;
  EXPECT_NEAR(slope_degrees(split(steep, settings)), 40, 1e-5);
}

TEST(GroundPlane, FollowsTheUpAxis) {
  Cloud<float> upright;
  add_plane<float>(upright, 2000, 10, 0, 0, -1.5F, 0.05F, 0.02F);
  add_plane<float>(upright, 300, 1, 3, 3, -0.5F);
  add_plane<float>(upright, 900, 10, 0, 0, 2.5F);  // the ceiling, ground to those who stand on their heads
  const GroundSplit expected = split(upright);
  ASSERT_TRUE(expected.found);
  EXPECT_EQ(expected.ground, numbers(0, 2000));
  for (unsigned axis = 0; axis < 6; ++axis) {
    SCOPED_TRACE(axis);
    GroundPlaneOptions settings;
    settings.up = axis_up(axis);
    const GroundSplit result = split(turned(upright, axis), settings);
    ASSERT_TRUE(result.found);
    EXPECT_GT(result.normal.dot(settings.up), 0.99);
    EXPECT_EQ(result.ground, expected.ground);
  }
  for (std::uint32_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(seed);
    const Eigen::Matrix3d rotation = any_rotation(seed);
    GroundPlaneOptions settings;
    settings.up = 0.1 * seed * rotation.col(2);
    const GroundSplit result = split(turned(upright, rotation), settings);
    ASSERT_TRUE(result.found);
    EXPECT_LT((result.normal - rotation * expected.normal).norm(), 1e-3);
    EXPECT_EQ(result.ground, expected.ground);
    for (const double scale : {0.25, 0x1p-600, 0x1p600}) {
      GroundPlaneOptions other = settings;
      other.up *= scale;
      const GroundSplit same = split(turned(upright, rotation), other);
      EXPECT_EQ(same.normal, result.normal);
      EXPECT_EQ(same.offset, result.offset);
    }
  }
}

TEST(GroundPlane, RefusesAnUpThatIsNone) {
  GroundPlaneOptions settings;
  for (const Eigen::Vector3d& up :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0, NAN, 1), Eigen::Vector3d(INFINITY, 0, 0)}) {
    settings.up = up;
    for (const Cloud<float>& cloud : {Cloud<float>{}, Cloud<float>{{0, 0, 0}}})
      EXPECT_THROW(split(cloud, settings), std::invalid_argument);
  }
}

TEST(GroundPlane, RefusesASensorThatIsNoPosition) {
  GroundPlaneOptions settings;
  for (const double bad : {double{NAN}, double{INFINITY}, -1.1e100}) {
    settings.sensor = {0, bad, 0};
    EXPECT_THROW(split(Cloud<float>{{0, 0, 0}}, settings), std::invalid_argument) << bad;
  }
}

TEST(GroundPlane, EachSeedFindsTheGroundAndGivesTheSameBitsAgain) {
  Cloud<float> cloud;
  add_plane<float>(cloud, 20'000, 20, 0, 0, 0, 0.05F, 0.05F);
  add_plane<float>(cloud, 20'000, 5, 3, 0, 1.5F, 0, 0.3F);
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    GroundPlaneOptions settings;
    settings.seed = seed;
    const GroundSplit result = split(cloud, settings);
    const GroundSplit again = split(cloud, settings);
    EXPECT_NEAR(result.offset, 0, 0.02);
    EXPECT_GE(result.ground.size(), 20'000U);
    EXPECT_EQ(result.normal, again.normal);
    EXPECT_EQ(result.offset, again.offset);
    EXPECT_EQ(result.ground, again.ground);
    EXPECT_EQ(result.rest, again.rest);
  }
}

TEST(GroundPlane, PrefersTheFloorToALargerTable) {
  for (std::uint32_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    Cloud<float> cloud;
    add_plane<float>(cloud, 600, 2, 0, 0, 0, 0, 0.01F);          // what is seen of the floor
    add_plane<float>(cloud, 9000, 1.2F, 0, 0, 0.75F, 0, 0.01F);  // the table
    add_plane<float>(cloud, 1000, 0.1F, 0.3F, 0, 0.9F, 0, 0.1F);
    GroundPlaneOptions settings;
    settings.distance = 0.03;
    settings.seed = seed;
    const GroundSplit result = split(cloud, settings);
    ASSERT_TRUE(result.found);
    EXPECT_EQ(result.ground, numbers(0, 600));
  }
}

TEST(GroundPlane, IsALowQuarterOfThePointsWhicheverOfFourTheyAre) {
  // Steps of the golden section visit them so that every fourth stays in one lane of the costs.
  for (int quarter = 0; quarter < 4; ++quarter) {
    Cloud<double> cloud;
    std::vector<std::int32_t> expected;
    for (int i = 0; i < 256; ++i) {
      const bool low = i % 4 == quarter;
      cloud.push_back({double(i % 16), double(i * 7 % 256) / 16, low ? 0.0 : 3.0});
      if (low) expected.push_back(i);
    }
    EXPECT_EQ(split(cloud).ground, expected) << quarter;
  }
}

TEST(GroundPlane, IsFoundUnderAForest) {
  Cloud<float> cloud;
  add_plane<float>(cloud, 1500, 20, 0, 0, 0, 0.05F, 0.05F);
  add_plane<float>(cloud, 17'000, 20, 0, 0, 6, 0.05F, 5);  // leaves 1 m to 11 m up
  for (std::uint32_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    GroundPlaneOptions settings;
    settings.seed = seed;
    settings.up = axis_up(seed % 6);
    EXPECT_EQ(split(turned(cloud, seed % 6), settings).ground, numbers(0, 1500));
  }
}

TEST(GroundPlane, TakesPointsBelowAsGroundButIsNotDrawnDownByThem) {
  Cloud<float> cloud;
  add_plane<float>(cloud, 5000, 20, 0, 0, 0, 0, 0.02F);
  add_plane<float>(cloud, 600, 20, 0, 0, -2, 0, 1.5F);  // reflections
  const std::size_t low = cloud.size();
  add_plane<float>(cloud, 300, 1, 5, 5, 1, 0, 0.5F);
  const GroundSplit result = split(cloud);
  ASSERT_TRUE(result.found);
  EXPECT_NEAR(result.offset, 0, 0.01);
  EXPECT_EQ(result.ground, numbers(0, low));
}

TEST(GroundPlane, TheSensorHeightExcludesOtherLevels) {
  Cloud<float> cloud;
  add_plane<float>(cloud, 4000, 10, 0, 0, -1.7F, 0.02F);
  add_plane<float>(cloud, 4000, 10, 0, 0, 2, 0.02F);
  add_plane<float>(cloud, 9000, 10, 0, 0, -5, 0.02F);  // a lower floor seen through a grating
  GroundPlaneOptions settings;
  EXPECT_NEAR(split(cloud, settings).offset, -5, 0.01);
  std::erase_if(cloud, [](const auto& p) { return p[2] < -3 && p[1] > -9; });
  settings.sensor_height = 1.5;
  EXPECT_NEAR(split(cloud, settings).offset, -1.7, 0.01);
  settings.sensor_height = 2.3;
  EXPECT_FALSE(split(cloud, settings).found);
}

TEST(GroundPlane, IsNoneWhenTooMuchLiesBelow) {
  for (const std::size_t below : {100U, 4000U}) {
    SCOPED_TRACE(below);
    Cloud<float> cloud;
    add_plane<float>(cloud, 4000, 5, 5, 0, -1.7F);
    add_plane<float>(cloud, below, 5, -5, 0, -6, 0, 3);
    GroundPlaneOptions settings;
    settings.sensor_height = 1.7;
    EXPECT_EQ(split(cloud, settings).found, below == 100);
  }
}

}  // namespace
}  // namespace pcl_bv::detail
