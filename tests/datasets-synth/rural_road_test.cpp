// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The rural road: its labels are right, moving objects move as stated, and it is as hard as it claims.
#include "pcl_bv/synth/rural_road.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "street_fixture.h"

namespace pcl_bv::detail {
namespace {

constexpr std::array<std::size_t, 4> sensors{16, 32, 64, 128};

const RuralRoadFrame& rural_road_sweep(std::size_t beams, std::uint64_t seed, std::size_t frame) {
  static std::map<std::array<std::uint64_t, 3>, RuralRoadFrame> sweeps;
  const auto [sweep, added] = sweeps.try_emplace({beams, seed, frame});
  if (added) sweep->second = make_rural_road_frame({seed, beams}, frame);
  return sweep->second;
}

Vector fixed_direction(const std::array<double, 12>& pose, const Vector& v) {
  Vector out{};
  for (std::size_t row = 0; row < 3; ++row)
    out[row] = pose[4 * row] * v[0] + pose[4 * row + 1] * v[1] + pose[4 * row + 2] * v[2];
  return out;
}

Vector fixed_point(const std::array<double, 12>& pose, const Vector& v) {
  Vector out = fixed_direction(pose, v);
  for (std::size_t row = 0; row < 3; ++row)
    out[row] += pose[4 * row + 3];
  return out;
}

Vector origin_of(const std::array<double, 12>& pose) {
  return {pose[3], pose[7], pose[11]};
}

double heading_of(const std::array<double, 12>& pose) {
  return std::atan2(pose[4], pose[0]);
}

const RuralRoadObject* find(const std::vector<RuralRoadObject>& objects, std::uint32_t id) {
  const auto object =
      std::lower_bound(objects.begin(), objects.end(), id,
                       [](const RuralRoadObject& o, std::uint32_t value) { return o.id < value; });
  return object != objects.end() && object->id == id ? &*object : nullptr;
}

bool may_move(SynthObjectKind kind) {
  return kind == SynthObjectKind::car || kind == SynthObjectKind::cyclist ||
         kind == SynthObjectKind::pedestrian;
}

TEST(RuralRoad, ReturnsLieInTheBoxOfTheirObjectAndBearItsKind) {
  for (const std::size_t beams : sensors) {
    SCOPED_TRACE(beams);
    const RuralRoadFrame& frame = rural_road_sweep(beams, 1, 40);
    std::size_t checked = 0;
    for (std::size_t i = 0; i < frame.cloud.size(); ++i) {
      const std::uint32_t id = frame.cloud.object[i];
      ASSERT_EQ(frame.cloud.kind[i] == 0, id == 0);
      if (id == 0) continue;
      ++checked;
      const RuralRoadObject* object = find(frame.objects, id);
      ASSERT_NE(object, nullptr) << id;
      ASSERT_EQ(frame.cloud.kind[i], 1 + static_cast<std::uint32_t>(object->kind));
      Vector p = point_of(frame.cloud, i);
      for (std::size_t axis = 0; axis < 3; ++axis)
        p[axis] -= object->center[axis];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        ASSERT_LT(std::abs(dot(object->axes[axis], p)), object->half_extents[axis] + noise_bound)
            << name_of(object->kind) << " ray " << i;
      }
    }
    EXPECT_GT(checked, 1000U);
  }
}

TEST(RuralRoad, APointHasOneLabelAndAllThreeOccur) {
  for (const std::size_t beams : sensors) {
    SCOPED_TRACE(beams);
    const SynthCloud& cloud = rural_road_sweep(beams, 1, 40).cloud;
    ASSERT_EQ(cloud.height, beams);
    std::array<std::size_t, 4> counts{};
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const std::uint32_t labels = cloud.ground[i] + cloud.vegetation[i] + (cloud.object[i] != 0 ? 1U : 0U);
      ASSERT_LE(labels, 1U) << i;
      if (!is_return(cloud, i)) {
        ASSERT_EQ(labels, 0U) << i;
        continue;
      }
      ++counts[cloud.ground[i] != 0 ? 0 : cloud.vegetation[i] != 0 ? 1 : cloud.object[i] != 0 ? 2 : 3];
    }
    EXPECT_GT(counts[0], 2000U);
    EXPECT_GT(counts[1], 200U);
    EXPECT_GT(counts[2], 1000U);
    // One ground return in 700 goes on below it.
    EXPECT_GT(counts[3], (counts[0] + counts[1]) / 1400);
    EXPECT_LT(counts[3], (counts[0] + counts[1]) / 350);
  }
}

TEST(RuralRoad, GroundPointsLieOnTheGroundAndGrassStandsOnIt) {
  for (const std::size_t beams : sensors) {
    SCOPED_TRACE(beams);
    const RuralRoadFrame& frame = rural_road_sweep(beams, 2, 25);
    std::size_t grown = 0, checked = 0;
    double grass = 0;
    for (std::size_t i = 0; i < frame.cloud.size(); i += 97) {
      if (frame.cloud.ground[i] == 0 && frame.cloud.vegetation[i] == 0) continue;
      const Vector p = fixed_point(frame.pose, point_of(frame.cloud, i));
      const double above = p[2] - rural_road_ground_height(2, 25, p[0], p[1]);
      // Roughness of up to 5 cm, noise of at most 12 cm along the ray, kerbs and ditches between nodes 0.25 m
      // apart.
      if (frame.cloud.ground[i] != 0) {
        ASSERT_NEAR(above, 0, 0.25) << i;
        ++checked;
      } else if (frame.cloud.vegetation[i] != 0) {
        ASSERT_GT(above, -0.25) << i;
        ASSERT_LT(above, 0.45) << i;
        grass += above;
        ++grown;
      }
    }
    ASSERT_GT(checked, 50U);
    ASSERT_GT(grown, 5U);
    EXPECT_GT(grass / static_cast<double>(grown), 0.02);
  }
}

TEST(RuralRoad, VelocitiesAreTheDifferencesOfCentersInTheFixedFrame) {
  for (const std::uint64_t seed : street_seeds) {
    SCOPED_TRACE(seed);
    std::size_t moving = 0;
    for (const std::size_t at : {5U, 60U, 121U, 170U, 240U}) {
      SCOPED_TRACE(at);
      const RuralRoadFrame before = make_rural_road_truth({seed, 16}, at - 1);
      const RuralRoadFrame now = make_rural_road_truth({seed, 16}, at);
      const RuralRoadFrame after = make_rural_road_truth({seed, 16}, at + 1);
      for (const RuralRoadObject& object : now.objects) {
        const RuralRoadObject* last = find(before.objects, object.id);
        const RuralRoadObject* next = find(after.objects, object.id);
        if (last == nullptr || next == nullptr) continue;
        const Vector a = fixed_point(before.pose, last->center), b = fixed_point(after.pose, next->center);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const double speed = (b[axis] - a[axis]) / 0.2;
          ASSERT_TRUE(may_move(object.kind) || object.velocity[axis] == 0) << object.id;
          // Over 0.2 s the vertical speed averages over kerbs; the rest bends by at most 4 m/s^2.
          ASSERT_NEAR(object.velocity[axis], speed, axis == 2 ? 1.3 : 0.45)
              << name_of(object.kind) << ' ' << object.id << " axis " << axis;
        }
        if (std::hypot(object.velocity[0], object.velocity[1]) > 0.5) ++moving;
      }
    }
    EXPECT_GT(moving, 50U);
  }
}

TEST(RuralRoad, YawRatesAreTheDifferencesOfHeadings) {
  for (const std::uint64_t seed : street_seeds) {
    SCOPED_TRACE(seed);
    double largest = 0;
    for (std::size_t at = 1; at < 200; at += 13) {
      const RuralRoadFrame now = make_rural_road_truth({seed, 16}, at);
      const RuralRoadFrame after = make_rural_road_truth({seed, 16}, at + 1);
      for (const RuralRoadObject& object : now.objects) {
        const RuralRoadObject* next = find(after.objects, object.id);
        if (next == nullptr) continue;
        const Vector a = fixed_direction(now.pose, object.axes[0]),
                     b = fixed_direction(after.pose, next->axes[0]);
        const double turned = std::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]) / 0.1;
        // Over 0.1 s, the curvature at 12 m/s comes within a third of a clothoid.
        ASSERT_NEAR(turned, 0.5 * (object.yaw_rate + next->yaw_rate), 0.1) << object.id << " frame " << at;
        largest = std::max(largest, std::abs(object.yaw_rate));
      }
    }
    EXPECT_GT(largest, 0.3);
  }
}

TEST(RuralRoad, SameArgumentsSameBitsAndOtherSeedsOtherRoads) {
  const RuralRoadFrame again = make_rural_road_frame({1, 16}, 40);
  const RuralRoadFrame& first = rural_road_sweep(16, 1, 40);
  EXPECT_EQ(again.cloud.xyz, first.cloud.xyz);
  EXPECT_EQ(again.cloud.object, first.cloud.object);
  EXPECT_EQ(again.cloud.ground, first.cloud.ground);
  EXPECT_EQ(again.cloud.vegetation, first.cloud.vegetation);
  EXPECT_EQ(again.pose, first.pose);
  ASSERT_EQ(again.objects.size(), first.objects.size());
  for (std::size_t i = 0; i < first.objects.size(); ++i) {
    EXPECT_EQ(again.objects[i].id, first.objects[i].id);
    EXPECT_EQ(again.objects[i].center, first.objects[i].center);
  }
  EXPECT_NE(make_rural_road_frame({2, 16}, 40).pose, first.pose);
}

TEST(RuralRoad, StandingThingsStayWhereTheyAreInEveryFrameThatSeesThem) {
  for (const std::uint64_t seed : street_seeds) {
    SCOPED_TRACE(seed);
    std::map<std::uint32_t, Vector> places;
    for (std::size_t at = 0; at < 200; at += 20) {
      const RuralRoadFrame frame = make_rural_road_truth({seed, 16}, at);
      for (const RuralRoadObject& object : frame.objects) {
        if (object.velocity != std::array<double, 3>{} || may_move(object.kind)) continue;
        const Vector place = fixed_point(frame.pose, object.center);
        const auto [known, added] = places.try_emplace(object.id, place);
        for (std::size_t axis = 0; axis < 3; ++axis)
          ASSERT_NEAR(known->second[axis], place[axis], 1e-6) << name_of(object.kind) << ' ' << object.id;
      }
    }
    EXPECT_GT(places.size(), 60U);
  }
}

TEST(RuralRoad, PosesAreRigidAndTiltedAsTheSensorIsMounted) {
  const std::map<std::size_t, std::array<double, 3>> mounts{// height, nose down, to a side; metres, degrees
                                                            {16, {1.2, 0, 0}},
                                                            {32, {2.4, 5, 0}},
                                                            {64, {1.73, 0, 0}},
                                                            {128, {2, 0, 2}}};
  const std::array<double, 12> level = rural_road_sweep(16, 1, 40).pose;
  for (const std::size_t beams : sensors) {
    SCOPED_TRACE(beams);
    const auto& pose = rural_road_sweep(beams, 1, 40).pose;
    const Vector x{pose[0], pose[4], pose[8]}, y{pose[1], pose[5], pose[9]}, z{pose[2], pose[6], pose[10]};
    for (const Vector& axis : {x, y, z})
      EXPECT_NEAR(dot(axis, axis), 1, 1e-12);
    EXPECT_NEAR(dot(x, y), 0, 1e-12);
    EXPECT_NEAR(x[1] * y[2] - x[2] * y[1], z[0], 1e-12);  // right-handed
    EXPECT_NEAR(x[2] * y[0] - x[0] * y[2], z[1], 1e-12);
    EXPECT_NEAR(x[0] * y[1] - x[1] * y[0], z[2], 1e-12);
    // The sensor of 16 beams is mounted level: the vehicle's own axes.
    const Vector forward{level[0], level[4], level[8]}, up{level[2], level[6], level[10]};
    const double degree = std::acos(-1.0) / 180;
    EXPECT_NEAR(dot(x, up), -std::sin(mounts.at(beams)[1] * degree), 1e-9);
    EXPECT_NEAR(dot(x, forward), std::cos(mounts.at(beams)[1] * degree), 1e-9);
    EXPECT_NEAR(dot(z, up), std::cos((mounts.at(beams)[1] + mounts.at(beams)[2]) * degree), 1e-9);
    const Vector low = origin_of(level), here = origin_of(pose);
    const Vector apart{here[0] - low[0], here[1] - low[1], here[2] - low[2]};
    EXPECT_NEAR(dot(apart, up), mounts.at(beams)[0] - 1.2, 1e-9);
  }
}

TEST(RuralRoad, TheVehicleClimbsTurnsAndStandsWithinThreeHundredFrames) {
  double sharpest = 0;
  for (const std::uint64_t seed : street_seeds) {
    SCOPED_TRACE(seed);
    double steepest = 0, fastest_turn = 0, fastest = 0, slowest = 1e9;
    Vector last{};
    double last_heading = 0;
    for (std::size_t at = 0; at < 300; ++at) {
      const auto pose = make_rural_road_truth({seed, 16}, at).pose;
      const Vector here = origin_of(pose);
      if (at > 0) {
        const double speed = std::hypot(here[0] - last[0], here[1] - last[1]) / 0.1;
        fastest = std::max(fastest, speed);
        slowest = std::min(slowest, speed);
        const double turn = std::remainder(heading_of(pose) - last_heading, 2 * std::acos(-1.0)) / 0.1;
        fastest_turn = std::max(fastest_turn, std::abs(turn) * 180 / std::acos(-1.0));
      }
      steepest = std::max(steepest, std::abs(pose[8]) / std::hypot(pose[0], pose[4]));
      last = here;
      last_heading = heading_of(pose);
    }
    EXPECT_GE(steepest, 0.12);
    EXPECT_LE(steepest, 0.17);
    EXPECT_GE(fastest_turn, 20);
    sharpest = std::max(sharpest, fastest_turn);
    EXPECT_LE(fastest_turn, 33);
    EXPECT_LE(slowest, 0.02);
    EXPECT_GE(fastest, 8);
    EXPECT_LE(fastest, 12.5);
  }
  EXPECT_GE(sharpest, 25);  // where it is fast: not on every road
}

TEST(RuralRoad, EveryKindOfThingIsSeenSomewhere) {
  std::array<std::size_t, 9> returns{};
  for (const std::uint64_t seed : street_seeds) {
    for (const std::size_t at : {0U, 40U, 100U, 160U, 220U}) {
      for (const std::uint32_t kind : rural_road_sweep(64, seed, at).cloud.kind)
        if (kind != 0) ++returns.at(kind - 1);
    }
  }
  for (std::size_t kind = 0; kind < returns.size(); ++kind)
    EXPECT_GT(returns[kind], 300U) << name_of(static_cast<SynthObjectKind>(kind));
}

TEST(RuralRoad, NobodyStandsWhereTheSensorDrives) {
  for (const std::uint64_t seed : street_seeds) {
    SCOPED_TRACE(seed);
    for (std::size_t at = 0; at < 300; at += 10) {
      for (const RuralRoadObject& object : make_rural_road_truth({seed, 16}, at).objects) {
        if (object.kind == SynthObjectKind::bridge || object.kind == SynthObjectKind::tree) continue;
        Vector sensor{};
        for (std::size_t axis = 0; axis < 3; ++axis)
          sensor[axis] = -dot(object.axes[axis], object.center);
        EXPECT_GT(std::max(std::abs(sensor[0]) - object.half_extents[0],
                           std::abs(sensor[1]) - object.half_extents[1]),
                  1)
            << name_of(object.kind) << ' ' << object.id << " frame " << at;
      }
    }
  }
}

TEST(RuralRoad, TheTruthAloneIsThatOfTheFrame) {
  for (const std::size_t beams : sensors) {
    const RuralRoadFrame& frame = rural_road_sweep(beams, 1, 40);
    const RuralRoadFrame truth = make_rural_road_truth({1, beams}, 40);
    EXPECT_EQ(truth.pose, frame.pose);
    EXPECT_EQ(truth.cloud.size(), 0U);
    ASSERT_EQ(truth.objects.size(), frame.objects.size());
    for (std::size_t i = 0; i < truth.objects.size(); ++i) {
      EXPECT_EQ(truth.objects[i].id, frame.objects[i].id);
      EXPECT_EQ(truth.objects[i].center, frame.objects[i].center);
      EXPECT_EQ(truth.objects[i].velocity, frame.objects[i].velocity);
    }
  }
}

TEST(RuralRoad, OtherNumbersOfBeamsAreRefusedWithTheNumberAndWhatIsAllowed) {
  for (const std::size_t beams : {0U, 15U, 40U, 256U}) {
    try {
      make_rural_road_frame({1, beams}, 0);
      FAIL() << beams;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(std::to_string(beams)), std::string::npos);
      EXPECT_NE(std::string(error.what()).find("16, 32, 64 or 128"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail
