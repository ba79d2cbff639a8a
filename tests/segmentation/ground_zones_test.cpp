// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The ground of many planes on scenes whose ground is known by construction: a sensor 1.7 m above it.
#include "pcl_bv/segmentation/ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "allocations.h"
#include "ground_scenes.h"

namespace pcl_bv::detail {
namespace {

GroundSplit split(const PointView& points, const GroundZonesOptions& settings = {}) {
  GroundSplit result;
  GroundZones().split(points, settings, result);
  return result;
}

// Of the ground's points, which come first, at least 99 % are found; of the others none.
void expect_split(const GroundSplit& result, std::size_t ground, std::size_t all) {
  ASSERT_TRUE(result.found);
  EXPECT_EQ(result.ground.size() + result.rest.size(), all);
  EXPECT_GE(static_cast<double>(result.ground.size()), 0.99 * static_cast<double>(ground));
  if (!result.ground.empty()) {
    EXPECT_LT(result.ground.back(), static_cast<std::int32_t>(ground));
  }
}

double level(double, double) {
  return -1.7;
}
double hill(double x, double) {
  return -1.7 + 0.12 * std::max(0.0, x - 15);
}
double ramp(double x, double) {
  return -1.7 + 0.2 * std::max(0.0, x - 20);
}
double valley(double x, double y) {
  return -1.7 - 0.1 * std::max(0.0, std::sqrt(x * x + y * y) - 12);
}
double wavy(double x, double y) {
  return -1.7 + 0.8 * std::sin(0.05 * x) + 0.6 * std::cos(0.06 * y) - 0.6;
}
double camber(double x, double y) {
  return -1.7 + 0.05 * x - 0.08 * y;
}
double ditch(double, double y) {
  const double t = std::min(1.0, std::abs(y - 10) / 3);
  return -1.7 - 0.28 * (1 + std::cos(3.14159265358979 * t));
}
double steep_along_x(double x, double) {
  return -1.7 + 0.6 * x;
}
double steep_along_y(double, double y) {
  return -1.7 + 0.6 * y;
}
double bank_along_x(double x, double) {
  return -1.7 + 0.45 * std::max(0.0, x - 5);
}
double bank_along_y(double, double y) {
  return -1.7 + 0.45 * std::max(0.0, y - 5);
}
double mound(double x, double y) {
  return -1.7 + 0.15 * std::clamp((3 - std::sqrt(x * x + y * y)) / 2.25, 0.0, 1.0);
}
// Rises to a slope of 0.45 on all sides.
double bowl(double x, double y) {
  const double r = std::max(0.0, std::sqrt(x * x + y * y) - 5);
  return -1.7 + (r < 15 ? 0.015 * r * r : 0.45 * r - 3.375);
}
double curb(double, double y) {
  return y > 4 || y < -3 ? -1.58 : -1.7;
}

TEST(GroundZones, FollowTheGround) {
  for (const Height height : {level, hill, valley, wavy, camber, curb}) {
    SCOPED_TRACE(height(40, 20));
    Cloud<float> cloud = ground_of(height);
    const std::size_t ground = cloud.size();
    add_boxes(cloud, height);
    expect_split(split(scene_view(cloud)), ground, cloud.size());
  }
}

// The first points of a patch are all at one side of it.
TEST(GroundZones, FollowTheGroundWithThousandsOfPointsAPatch) {
  Cloud<float> cloud;
  for (int i = 0; i < 400; ++i)
    for (int k = 0; k < 400; ++k) {
      const double x = 5 + 0.04 * i, y = 0.04 * k - 8;
      cloud.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(hill(x, y))});
    }
  expect_split(split(scene_view(cloud)), cloud.size(), cloud.size());
}

TEST(GroundZones, ClimbARampThatBeginsWithinAPatch) {
  const GroundSplit result = split(scene_view(ground_of(ramp)));
  EXPECT_GE(result.ground.size(), 39'400U);  // of 40'500; 36'641 without a look for ramps
}

TEST(GroundZones, FollowASlopeAsSteepAsAllowed) {
  GroundZonesOptions settings;
  settings.max_slope_degrees = 45;
  for (const Height height : {steep_along_x, steep_along_y}) {
    const Cloud<float> cloud = ground_of(height);
    expect_split(split(scene_view(cloud), settings), cloud.size(), cloud.size());
  }
}

// The ground of a cell rises by 0.22 m, which is more than `distance`.
TEST(GroundZones, FollowASlopeWithinACell) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  Cloud<float> cloud;
  for (int i = 0; i < 100'000; ++i) {
    const double r = std::sqrt(9 + 891 * unit(random)), angle = 2 * std::numbers::pi * unit(random);
    const double x = r * std::cos(angle), y = r * std::sin(angle);
    cloud.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(bowl(x, y))});
  }
  GroundZonesOptions settings;
  settings.max_slope_degrees = 45;
  expect_split(split(scene_view(cloud), settings), cloud.size(), cloud.size());
}

TEST(GroundZones, EndWhereASlopeIsSteeperThanAllowed) {
  for (const Height height : {bank_along_x, bank_along_y}) {
    const Cloud<float> cloud = ground_of(height);
    const GroundSplit result = split(scene_view(cloud));
    ASSERT_TRUE(result.found);
    for (const std::int32_t i : result.ground)
      ASSERT_LT(cloud[static_cast<std::size_t>(i)][2], 0) << i;
  }
}

TEST(GroundZones, GoWhereOnePlaneCannot) {
  for (const Height height : {hill, valley, wavy}) {
    Cloud<float> cloud = ground_of(height);
    const std::size_t ground = cloud.size();
    const GroundSplit plane = split(cloud, GroundPlaneOptions{});
    EXPECT_LT(static_cast<double>(plane.ground.size()), 0.97 * static_cast<double>(ground)) << height(40, 20);
  }
}

TEST(GroundZones, KnowTheHeightOfTheSensor) {
  const GroundSplit result = split(scene_view(ground_of(camber)));
  ASSERT_TRUE(result.found);
  EXPECT_NEAR(-result.offset / result.normal.z(), 1.7, 0.02);
  EXPECT_NEAR(-result.normal.x() / result.normal.z(), 0.05, 0.005);
  EXPECT_NEAR(-result.normal.y() / result.normal.z(), -0.08, 0.005);
  EXPECT_NEAR(result.normal.norm(), 1, 1e-12);
}

TEST(GroundZones, TakeAWrongSensorHeightAsAHint) {
  for (const double height : {1.4, 1.7, 2.0}) {
    SCOPED_TRACE(height);
    Cloud<float> cloud = ground_of(hill);
    const std::size_t ground = cloud.size();
    add_boxes(cloud, hill);
    GroundZonesOptions settings;
    settings.sensor_height = height;
    expect_split(split(scene_view(cloud), settings), ground, cloud.size());
  }
}

TEST(GroundZones, TakeReflectionsBelowAsGroundButAreNotDrawnDownByThem) {
  Cloud<float> cloud = ground_of(camber);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(-1, 1);
  for (int i = 0; i < 3000; ++i) {
    const float x = 25 * unit(random), y = 25 * unit(random);
    const float depth = i % 2 ? 2 + 1.5F * unit(random) : 0.35F;
    cloud.push_back({x, y, static_cast<float>(camber(x, y)) - depth});
  }
  const std::size_t low = cloud.size();
  add_boxes(cloud, camber);
  expect_split(split(scene_view(cloud)), low, cloud.size());
}

TEST(GroundZones, DoNotTakeAWallsFootForGround) {
  Cloud<float> cloud = ground_of(level);
  std::erase_if(cloud, [](const auto& p) { return p[1] > 6; });
  const std::size_t ground = cloud.size();
  for (float x = -20; x < 20; x += 0.05F) {
    for (float z = -1.6F; z < 1; z += 0.05F)  // 0.1 m above the ground and more
      cloud.push_back({x, 6, z});
  }
  expect_split(split(scene_view(cloud)), ground, cloud.size());
}

// In every second sector, and in a margin beside it, no ground is visible within 0.5 m of the wall. So the
// lowest point of the cell is on the wall, 2 cm above the ground. The sectors between show the height of the
// ground. Without them, points up to 7 cm above the ground would be ground.
TEST(GroundZones, TakeTheGroundAtAWallFromTheSectorsBeside) {
  constexpr float wall = 6.4F;
  const auto wall_hides = [](double x, double y) {
    const double sectors = std::fmod(std::atan2(y, x) * 128 / std::numbers::pi, 2);
    return y > wall - 0.5 && (sectors < 0.2 || sectors > 0.8);
  };
  Cloud<float> cloud = ground_of(level);
  for (float x = -2; x < 2; x += 0.02F) {
    for (float y = 5; y < wall; y += 0.05F)
      cloud.push_back({x, y, -1.7F});
  }
  std::erase_if(cloud, [&](const auto& p) { return p[1] > wall || wall_hides(p[0], p[1]); });
  for (float x = -1; x < 1; x += 0.01F)
    cloud.push_back({x, wall, -1.68F});
  const std::size_t ground = cloud.size();
  for (float x = -1; x < 1; x += 0.01F) {
    for (const float z : {-1.64F, -1.5F, -1.3F, -1.1F, -0.9F})
      cloud.push_back({x, wall, z});
  }
  expect_split(split(scene_view(cloud)), ground, cloud.size());
}

// Nothing of the road is seen for 28 m, in which it climbs by 3 m: the sectors beside know it.
TEST(GroundZones, GoOnWhereALorryHidesTheRoad) {
  Cloud<float> cloud = ground_of(hill);
  std::erase_if(cloud, [](const auto& p) { return p[0] > 12 && p[0] < 40 && std::abs(p[1]) < 0.2F * p[0]; });
  const std::size_t ground = cloud.size();
  for (float y = -2.4F; y < 2.4F; y += 0.05F) {
    for (float z = -1.3F; z < 2; z += 0.05F)
      cloud.push_back({12, y, z});
  }
  expect_split(split(scene_view(cloud)), ground, cloud.size());
}

// 0.56 m deep and 6 m wide.
TEST(GroundZones, GoOnBehindADitch) {
  const Cloud<float> cloud = ground_of(ditch);
  const GroundSplit result = split(scene_view(cloud));
  const auto behind = [&](std::int32_t i) { return cloud[static_cast<std::size_t>(i)][1] > 13; };
  const std::vector<std::int32_t> all = numbers(0, cloud.size());
  const auto there = std::count_if(all.begin(), all.end(), behind);
  const auto found = std::count_if(result.ground.begin(), result.ground.end(), behind);
  EXPECT_GE(static_cast<double>(found), 0.99 * static_cast<double>(there));
}

// Within half a metre no ground is seen: a point there is 0.3 m above level ground, 0.15 m above the mound.
TEST(GroundZones, RiseUnderTheSensorWithTheGroundAroundIt) {
  GroundZonesOptions settings;
  settings.distance = 0.2;
  for (const Height height : {level, mound}) {
    Cloud<float> cloud = ground_of(height);
    for (double radius = 0.75; radius < 3; radius += 0.5) {
      for (int i = 0; i < 512; ++i) {
        const double angle = (i + 0.5) * std::numbers::pi / 256;
        const double x = radius * std::cos(angle), y = radius * std::sin(angle);
        cloud.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(height(x, y))});
      }
    }
    cloud.push_back({0.3F, 0.1F, -1.4F});
    const GroundSplit result = split(scene_view(cloud), settings);
    EXPECT_EQ(result.rest, numbers(height == mound ? cloud.size() : cloud.size() - 1, cloud.size()));
  }
}

TEST(GroundZones, AreNoneWithoutPoints) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const Cloud<float>& cloud :
       {Cloud<float>{}, Cloud<float>{{nan, 0, 0}, {0, INFINITY, 0}}, Cloud<float>{{1, 2, 3}}}) {
    const GroundSplit result = split(scene_view(cloud));
    EXPECT_FALSE(result.found);
    EXPECT_TRUE(result.ground.empty());
    EXPECT_EQ(result.rest.size(), cloud.size() == 1 ? 1U : 0U);
    EXPECT_EQ(result.normal, Eigen::Vector3d::Zero());
  }
}

TEST(GroundZones, AreLevelButEmptyWithoutPointsIfTheSensorIsGiven) {
  GroundZonesOptions settings;
  settings.sensor = Eigen::Vector3d::Zero();
  settings.sensor_height = 1.7;
  const GroundSplit result = split_ground_by_zones(scene_view(Cloud<float>{}), settings);
  EXPECT_TRUE(result.assumed_level);
  EXPECT_TRUE(result.ground.empty());
  EXPECT_TRUE(result.rest.empty());
}

TEST(GroundZones, AreAllOfABareField) {
  const Cloud<float> cloud = ground_of(level);
  EXPECT_EQ(split(scene_view(cloud)).ground, numbers(0, cloud.size()));
}

TEST(GroundZones, AreNoneBeforeAWall) {
  Cloud<float> cloud;
  for (float y = -10; y < 10; y += 0.1F) {
    for (float z = -1; z < 3; z += 0.1F)
      cloud.push_back({7, y, z});
  }
  EXPECT_FALSE(split(scene_view(cloud)).found);
  GroundZonesOptions settings;
  settings.sensor_height = 1.7;
  const GroundSplit result = split(scene_view(cloud), settings);
  EXPECT_TRUE(result.found);  // Level ground 1.7 m below, of which nothing is seen.
  EXPECT_EQ(result.rest, numbers(0, cloud.size()));
}

TEST(GroundZones, SkipPointsWithAnyCoordinateNotFinite) {
  Cloud<float> cloud = ground_of(hill);
  const GroundSplit before = split(scene_view(cloud));
  Cloud<float> spoiled;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    spoiled.push_back(cloud[i]);
    spoiled.push_back({i % 3 == 0 ? NAN : 1.F, i % 3 == 1 ? INFINITY : 1.F, i % 3 == 2 ? -INFINITY : 1.F});
  }
  const GroundSplit result = split(scene_view(spoiled));
  for (const auto* list : {&result.ground, &result.rest}) {
    for (const std::int32_t i : *list)
      ASSERT_EQ(i % 2, 0);
  }
  EXPECT_EQ(result.ground.size() + result.rest.size(), cloud.size());
  EXPECT_GE(static_cast<double>(result.ground.size()), 0.99 * static_cast<double>(before.ground.size()));
}

TEST(GroundZones, FollowTheUpAxis) {
  Cloud<float> upright = ground_of(camber);
  const std::size_t ground = upright.size();
  add_boxes(upright, camber);
  for (unsigned axis = 0; axis < 6; ++axis) {
    SCOPED_TRACE(axis);
    GroundZonesOptions settings;
    settings.up = axis_up(axis);
    const GroundSplit result = split(scene_view(turned(upright, axis)), settings);
    EXPECT_GT(result.normal.dot(settings.up), 0.99);
    expect_split(result, ground, upright.size());
  }
}

TEST(GroundZones, AreLevelAtTheSensorsHeightWhereNoneAreSeen) {
  GroundZonesOptions settings;
  settings.up = {0, -3, 4};
  settings.sensor = {10, 20, 30};
  settings.sensor_height = 1.5;
  const GroundSplit result = split(scene_view(Cloud<float>{{10, 20, 30}}), settings);
  EXPECT_EQ(result.normal, Eigen::Vector3d(0, -0.6, 0.8));
  EXPECT_EQ(result.offset, -0.6 * 20 + 0.8 * 30 - 1.5);
  EXPECT_EQ(result.rest, numbers(0, 1));
}

TEST(GroundZones, FindTheSensorInTheMapsFrame) {
  Cloud<float> local = ground_of(wavy);
  const std::size_t ground = local.size();
  add_boxes(local, wavy);
  GroundZonesOptions settings;
  settings.sensor = {4e5, 5e6, 300};
  Cloud<double> map;
  for (const auto& p : local)
    map.push_back({4e5 + p[0], 5e6 + p[1], 300.0 + p[2]});
  expect_split(split(scene_view(map), settings), ground, map.size());
  settings.sensor_height = 1.7;
  expect_split(split(scene_view(map), settings), ground, map.size());
}

TEST(GroundZones, NameTheCloudsPointsThroughListsAndSlices) {
  Cloud<float> cloud = ground_of(hill);
  const std::size_t ground = cloud.size();
  add_boxes(cloud, hill);
  const GroundSplit whole = split(scene_view(cloud));
  std::vector<std::int32_t> all = numbers(0, cloud.size());
  PointView listed = scene_view(cloud);
  listed.indices = all.data();
  EXPECT_EQ(split(listed).ground, whole.ground);
  Cloud<float> longer(1000, {0, 0, 50});
  longer.insert(longer.end(), cloud.begin(), cloud.end());
  const GroundSplit sliced = split(scene_view(longer).slice(1000, cloud.size()));
  ASSERT_EQ(sliced.ground.size(), whole.ground.size());
  for (std::size_t i = 0; i < whole.ground.size(); ++i)
    ASSERT_EQ(sliced.ground[i], whole.ground[i] + 1000);
  EXPECT_LT(sliced.ground.back(), static_cast<std::int32_t>(1000 + ground));
  PointView listed_of_slice = scene_view(longer).slice(1000, cloud.size());
  listed_of_slice.indices = all.data();
  const GroundSplit both = split(listed_of_slice);
  EXPECT_EQ(both.ground, whole.ground);
  EXPECT_EQ(both.offset, whole.offset) << "of the plane near the sensor";
}

TEST(GroundZones, OutliveGreatCoordinates) {
  Cloud<double> cloud;
  for (const auto& p : ground_of(level))
    cloud.push_back({p[0], p[1], p[2]});
  const std::size_t ground = cloud.size();
  cloud.push_back({1e99, -1e99, 1e99});
  cloud.push_back({-3e38, 3e38, 1});
  const GroundSplit result = split(scene_view(cloud));
  ASSERT_TRUE(result.found);
  EXPECT_GE(result.ground.size(), ground);
  EXPECT_EQ(result.ground.size() + result.rest.size(), cloud.size());
}

TEST(GroundZones, RefuseSettingsOutOfRange) {
  const auto refuses = [](auto change) {
    GroundZonesOptions settings;
    change(settings);
    EXPECT_THROW(split(scene_view(Cloud<float>{{0, 0, 0}}), settings), std::invalid_argument);
  };
  for (const double bad : {0.0, -1.0, double{INFINITY}, double{NAN}})
    refuses([bad](auto& s) { s.distance = bad; });
  for (const double bad : {-1.0, 90.0, double{NAN}})
    refuses([bad](auto& s) { s.max_slope_degrees = bad; });
  for (const double bad : {-0.1, double{INFINITY}, double{NAN}})
    refuses([bad](auto& s) { s.sensor_height = bad; });
  for (const double bad : {double{INFINITY}, double{NAN}}) {
    refuses([bad](auto& s) { s.sensor = Eigen::Vector3d(0, bad, 0); });
    refuses([bad](auto& s) { s.up.y() = bad; });
  }
  refuses([](auto& s) { s.up.setZero(); });
}

TEST(GroundZones, AreTheSameFromAnyNumberOfThreads) {
  Cloud<float> cloud = ground_of(hill);
  add_boxes(cloud, hill);
  for (std::size_t i = 0; i < cloud.size(); i += 700)
    cloud[i][0] = std::numeric_limits<float>::quiet_NaN();
  const PointView all = scene_view(cloud);
  ASSERT_GT(all.count, 25'000U);  // in parts
  GroundZonesOptions tilted;
  tilted.up = {0.1, -0.2, 1};
  tilted.sensor = {0.5, 0.25, 0};
  for (const PointView& points : {all, all.slice(1000, all.count - 3000), all.slice(5, 20'000)}) {
    for (const GroundZonesOptions& settings : {GroundZonesOptions(), tilted}) {
      const GroundSplit alone = split(points, settings);
      ASSERT_TRUE(alone.found);
      GroundZones zones;
      for (const unsigned threads : {2U, 3U, 7U}) {
        GroundSplit together;
        zones.split(points, settings, together, Threads{threads});
        EXPECT_EQ(together.ground, alone.ground) << threads;
        EXPECT_EQ(together.rest, alone.rest) << threads;
        EXPECT_EQ(together.normal, alone.normal);
        EXPECT_EQ(together.offset, alone.offset);
      }
    }
  }
}

TEST(GroundZones, OfAUsedObjectAreThoseOfAFreshOneAndTakeNoMemory) {
  std::vector<Cloud<float>> clouds{ground_of(hill), ground_of(level), ground_of(wavy)};
  clouds[1].resize(5000);
  std::vector<GroundSplit> fresh;
  for (Cloud<float>& cloud : clouds) {
    add_boxes(cloud, hill);
    fresh.push_back(split(scene_view(cloud)));
  }
  GroundZones zones;
  GroundSplit used;
  std::size_t before = 0;
  for (int pass = 0; pass < 3; ++pass) {
    if (pass == 1) before = allocations();
    for (std::size_t i = 0; i < clouds.size(); ++i) {
      zones.split(scene_view(clouds[i]), {}, used);
      EXPECT_TRUE(used.ground == fresh[i].ground && used.rest == fresh[i].rest);
      EXPECT_TRUE(used.normal == fresh[i].normal && used.offset == fresh[i].offset);
    }
  }
  EXPECT_EQ(allocations(), before);
}

}  // namespace
}  // namespace pcl_bv::detail
