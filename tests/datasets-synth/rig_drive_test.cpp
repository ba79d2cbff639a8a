// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/synth/rig_drive.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>

namespace pcl_bv::detail {
namespace {

using Point = std::array<double, 3>;

Point moved(const RigPose& m, const Point& p) {
  Point to{};
  for (std::size_t i = 0; i < 3; ++i)
    to[i] = m[4 * i] * p[0] + m[4 * i + 1] * p[1] + m[4 * i + 2] * p[2] + m[4 * i + 3];
  return to;
}

// Returns the distance from the surface, seen from above; of the roof, from the side.
double distance(const RigObject& object, const Point& p) {
  const double x = p[0] - object.x, y = p[1] - object.y, roof = std::abs(p[2] - object.height);
  const double c = std::cos(object.yaw), s = std::sin(object.yaw);
  const double across = object.radius > 0 ? std::hypot(x, y) - object.radius
                                          : std::max(std::abs(c * x + s * y) - object.length / 2,
                                                     std::abs(c * y - s * x) - object.width / 2);
  return across < 0 ? std::min(-across, roof) : across;
}

TEST(RigDriveSweep, HasItsPointsOnTheirObjectsAtTheTimeOfEachPoint) {
  RigDriveOptions options;
  options.noise = 0;
  const RigDrive drive(options);
  for (std::size_t sensor = 0; sensor < kRigSensors; ++sensor) {
    const RigSweep sweep = drive.sweep(sensor, 7);
    ASSERT_EQ(sweep.xyz.size(), 3 * sweep.ring.size());
    std::size_t on_objects = 0;
    for (std::size_t i = 0; i < sweep.ring.size(); ++i) {
      const Point p{sweep.xyz[3 * i], sweep.xyz[3 * i + 1], sweep.xyz[3 * i + 2]};
      if (p == Point{}) continue;
      const double now = sweep.seconds + 1e-9 * sweep.time_ns[i];
      const Point at = moved(drive.pose(now), moved(RigDrive::mounting(sensor), p));
      if (sweep.object[i] == 0) {
        ASSERT_NEAR(at[2], 0, 1e-4);
        continue;
      }
      ++on_objects;
      ASSERT_NEAR(distance(drive.objects(now)[sweep.object[i] - 1], at), 0, 1e-4) << sensor << ' ' << i;
    }
    EXPECT_GT(on_objects, 3000U);
  }
}

TEST(RigDriveSweep, IsTheSameForTheSameOptionsAndOtherForAnotherSeed) {
  const RigDrive drive({}), same({});
  RigDriveOptions other;
  other.seed = 2;
  EXPECT_EQ(drive.sweep(1, 3).xyz, same.sweep(1, 3).xyz);
  EXPECT_NE(drive.sweep(1, 3).xyz, RigDrive(other).sweep(1, 3).xyz);
}

TEST(RigDriveSweep, OverlapsWithThatOfTheOtherSensor) {
  const RigDrive drive({});
  const RigSweep front = drive.sweep(0, 0), rear = drive.sweep(1, 0);
  const std::set<std::uint32_t> ahead(front.object.begin(), front.object.end()),
      behind(rear.object.begin(), rear.object.end());
  std::size_t both = 0;
  for (const std::uint32_t object : ahead)
    both += object > 0 && behind.count(object) > 0;
  EXPECT_GE(both, 3U);
}

TEST(RigDrive, TurnsAtThirtyDegreesASecondAndHitsNothing) {
  const RigDrive drive({});
  const auto yaw = [&](double t) { return std::atan2(drive.pose(t)[4], drive.pose(t)[0]); };
  EXPECT_NEAR(std::remainder(yaw(5.5) - yaw(5), 2 * std::numbers::pi) / 0.5, std::numbers::pi / 6, 1e-9);
  for (double t = 0; t < 60; t += 0.1) {
    const RigPose pose = drive.pose(t);
    for (const RigObject& object : drive.objects(t))
      ASSERT_GT(distance(object, {pose[3], pose[7], object.height / 2}), 2.5) << t;
  }
}

TEST(RigDrive, RejectsNumbersThatAreNotPositive) {
  RigDriveOptions options;
  options.speed = 0;
  EXPECT_THROW(RigDrive{options}, std::invalid_argument);
  options = {};
  options.beams = 1;
  EXPECT_THROW(RigDrive{options}, std::invalid_argument);
}

TEST(RigSequence, IsReadFromItsName) {
  EXPECT_EQ(parse_rig_sequence("rig").frames, 300U);
  EXPECT_EQ(parse_rig_sequence("rig:20:7").frames, 20U);
  EXPECT_EQ(parse_rig_sequence("rig:20:7").seed, 7U);
  for (const char* bad : {"rigs", "rig:", "rig:0", "rig:1:2:3", "rig:x", "rig:-1"})
    EXPECT_THROW(parse_rig_sequence(bad), std::invalid_argument) << bad;
}

}  // namespace
}  // namespace pcl_bv::detail
