// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Sweeps one after the other: same bits for the same arguments, steady ids, constant velocities.
#include <gtest/gtest.h>

#include <map>

#include "street_fixture.h"

namespace pcl_bv::detail {
namespace {

TEST(StreetSequence, SameArgumentsGiveTheSameBits) {
  for (const std::size_t frame : {0u, 3u}) {
    const StreetFrame a = make_street_frame({12'800, 5}, frame);
    const StreetFrame b = make_street_frame({12'800, 5}, frame);
    EXPECT_EQ(a.cloud.xyz, b.cloud.xyz);
    EXPECT_EQ(a.cloud.object, b.cloud.object);
    EXPECT_EQ(a.cloud.ground, b.cloud.ground);
  }
}

TEST(StreetSequence, AnotherSeedOrFrameGivesAnotherSweep) {
  const auto sweep = [](std::uint64_t seed, std::size_t frame) {
    return make_street_frame({12'800, seed}, frame).cloud.xyz;
  };
  EXPECT_NE(sweep(5, 0), sweep(6, 0));
  EXPECT_NE(sweep(5, 0), sweep(5, 1));
}

TEST(StreetSequence, ObjectsMoveByTheirVelocityAndKeepAllElse) {
  for (const std::uint64_t seed : street_seeds) {
    SCOPED_TRACE(seed);
    std::map<std::uint32_t, StreetObject> first;
    for (const StreetObject& object : make_street_frame({64, seed}, 0).objects)
      first[object.id] = object;
    std::size_t common = 0;
    for (const StreetObject& later : make_street_frame({64, seed}, 10).objects) {
      if (!first.contains(later.id)) continue;
      ++common;
      const StreetObject& object = first[later.id];
      EXPECT_EQ(later.kind, object.kind);
      EXPECT_EQ(later.axes, object.axes);
      EXPECT_EQ(later.half_extents, object.half_extents);
      EXPECT_EQ(later.velocity, object.velocity);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(later.center[axis], object.center[axis] + 10 * 0.1 * object.velocity[axis], 1e-9);
      }
    }
    EXPECT_GT(common, first.size() * 8 / 10);
  }
}

TEST(StreetSequence, TheSensorPassesWhatStandsAtEightMetresPerSecond) {
  std::map<double, int> speeds;
  for (const StreetObject& object : street_sweep(1).objects) {
    EXPECT_EQ(object.velocity[1], 0);
    EXPECT_NEAR(object.velocity[2], street_slope * object.velocity[0], 1e-12);
    if (object.kind != SynthObjectKind::car && object.kind != SynthObjectKind::pedestrian) {
      EXPECT_EQ(object.velocity[0], -8);
    } else {
      ++speeds[object.velocity[0] + 8];
    }
  }
  EXPECT_GT(speeds[0], 5);    // parked
  EXPECT_GT(speeds[8], 2);    // the sensor's lane
  EXPECT_GT(speeds[-11], 2);  // oncoming
  EXPECT_EQ(speeds.size(), 7u) << "and four lanes of pedestrians";
}

TEST(StreetSequence, TheStreetGoesOnWithoutEnd) {
  for (const std::size_t frame : {500u, 100'000u, 999'999u}) {
    SCOPED_TRACE(frame);
    const StreetFrame sweep = make_street_frame({6'400, 1}, frame);
    EXPECT_GT(sweep.objects.size(), 150u);
    std::size_t ground = 0;
    for (const std::uint32_t flag : sweep.cloud.ground)
      ground += flag;
    EXPECT_GT(ground, 1600u);
  }
}

TEST(StreetSequence, EveryFrameHasNoiseOfItsOwn) {
  // The ground looks the same from every frame: only noise tells its returns apart.
  const SynthCloud a = make_street_frame({12'800, 5}, 0).cloud;
  const SynthCloud b = make_street_frame({12'800, 5}, 1).cloud;
  std::size_t both = 0;
  std::size_t same = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a.ground[i] == 0 || b.ground[i] == 0) continue;
    ++both;
    same += point_of(a, i) == point_of(b, i);
  }
  EXPECT_GT(both, 1000u);
  EXPECT_LT(same, both / 100);
}

}  // namespace
}  // namespace pcl_bv::detail
