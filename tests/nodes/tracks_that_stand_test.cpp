// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What moves and what does not, while its parts come and go and the sensor turns and brakes.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "pipeline/track/motion_classifier.h"
#include "pipeline/track/tracker.h"

namespace pcl_bv::detail {
namespace {

constexpr double kFrame = 0.1;  // seconds

// Ends with the answer to `frames` sightings, the box of each made by centre_and_half(i).
template <typename Make>
bool moves(int frames, Make&& centre_and_half) {
  MotionClassifier classifier;
  for (int i = 0; i < frames; ++i) {
    const std::array<Eigen::Vector3d, 2> box = centre_and_half(i);
    classifier.add(box[0], box[1], Eigen::Matrix3d::Identity(), i == 0 ? 0 : kFrame);
  }
  return classifier.moving();
}

const Eigen::Vector3d kPerson(0.25, 0.25, 0.9);

TEST(MotionClassifier, AWalkerMovesWithinHalfASecond) {
  const auto walk = [](int i) { return std::array<Eigen::Vector3d, 2>{{{1.2 * kFrame * i, 3, 0}, kPerson}}; };
  EXPECT_FALSE(moves(2, walk));
  EXPECT_TRUE(moves(5, walk));
}

TEST(MotionClassifier, PartsThatComeIntoViewDoNotMove) {
  // One face stays at 0, the other one goes at 2 m/s: the centre goes at 1 m/s.
  EXPECT_FALSE(moves(20, [](int i) {
    const double length = 1 + 2 * kFrame * i;
    return std::array<Eigen::Vector3d, 2>{{{length / 2, 3, 0}, {length / 2, 0.5, 0.5}}};
  }));
}

TEST(MotionClassifier, PartsThatTakeTurnsDoNotMove) {
  for (int period = 2; period < 5; ++period) {
    for (int frames = 5; frames < 25; ++frames) {
      EXPECT_FALSE(
          moves(frames,
                [&](int i) {
                  return std::array<Eigen::Vector3d, 2>{{{i / period % 2 == 0 ? 0.0 : 0.8, 3, 0}, kPerson}};
                }))
          << period << " " << frames;
    }
  }
}

// Other faces of a car come into view, which displace its box by 0.5 m within 0.2 s.
TEST(MotionClassifier, AShortShiftOfALongObjectIsNoMotion) {
  const Eigen::Vector3d car(2, 0.9, 0.75), bush(0.5, 0.5, 0.5);
  const auto at_speed = [](double speed, const Eigen::Vector3d& half) {
    return [=](int i) { return std::array<Eigen::Vector3d, 2>{{{speed * kFrame * i, 3, 0}, half}}; };
  };
  EXPECT_FALSE(moves(3, at_speed(2.5, car)));
  EXPECT_TRUE(moves(3, at_speed(2.5, kPerson)));
  EXPECT_TRUE(moves(6, at_speed(2.5, car)));
  // An object of 1 m moves above 0.9 m/s.
  EXPECT_FALSE(moves(20, at_speed(0.8, bush)));
  EXPECT_TRUE(moves(20, at_speed(1.1, bush)));
}

TEST(MotionClassifier, WhatHasStoppedStandsWithinASecond) {
  const auto stop = [](int i) {
    return std::array<Eigen::Vector3d, 2>{{{5 * kFrame * std::min(i, 10), 3, 0}, kPerson}};
  };
  EXPECT_TRUE(moves(11, stop));
  EXPECT_FALSE(moves(18, stop));
}

TEST(MotionClassifier, StampsWithoutTimeBetweenThemSayNothing) {
  MotionClassifier classifier;
  for (int i = 0; i < 50; ++i) {
    classifier.add({0.2 * i, 0, 0}, kPerson, Eigen::Matrix3d::Identity(), 0);
    EXPECT_FALSE(classifier.moving());
  }
}

Aabb cube(const Eigen::Vector3d& centre, double size) {
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(size / 2);
  return {centre - half, centre + half};
}

// A post of which a bush beside it hides the most for a while, from a vehicle that turns by 30 degrees a
// second.
TEST(Tracker, WhatWasSeenInOtherPartsStandsWhileTheVehicleTurns) {
  Tracker tracker;
  const Eigen::Vector3d post(20, 3, 0), bush(20, 5.5, 0);
  for (int i = 0; i < 40; ++i) {
    Pose sensor = Pose::Identity();
    sensor.linear() =
        Eigen::AngleAxisd(i < 12 ? 0 : 0.0524 * (i - 12), Eigen::Vector3d::UnitZ()).toRotationMatrix();
    const Eigen::Vector3d seen = sensor.inverse() * (i < 5 ? bush : post), other = sensor.inverse() * post;
    Aabb box = cube(seen, 0.4);
    if (i == 5 || i == 6)
      box = {seen.cwiseMin(other) - Eigen::Vector3d::Constant(0.2),
             (sensor.inverse() * bush).cwiseMax(other) + Eigen::Vector3d::Constant(0.2)};
    std::vector<Tracker::Assignment> found;
    TrackConfig config;
    config.gate = 4;
    tracker.update(i * 100'000'000LL, {box}, config, found, sensor);
    if (i < 20) continue;
    ASSERT_TRUE(found[0].track) << i;
    EXPECT_LT(found[0].track->velocity.norm(), 0.3) << i;
    EXPECT_FALSE(found[0].track->moving) << i;
  }
}

// An error of the vehicle's velocity must not become one of all that stands.
TEST(Tracker, AfterBrakingWithoutPosesTheVehicleStandsAndAllThatStandsToo) {
  constexpr unsigned kSeed = 7;
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> along(-30, 90), across(-20, 20);
  std::normal_distribution<double> noise(0, 0.06);
  std::vector<Eigen::Vector3d> posts;
  for (int i = 0; i < 120; ++i)
    posts.emplace_back(along(random), across(random), 0);
  Tracker tracker;
  double x = 0, speed = 10, stopped = 0;
  std::size_t count = 0;
  for (int i = 0; i < 60; ++i) {
    std::vector<Aabb> boxes;
    for (const Eigen::Vector3d& post : posts) {
      const Eigen::Vector3d seen = post + Eigen::Vector3d(noise(random) - x, noise(random), 0);
      if (seen.norm() < 30) boxes.push_back(cube(seen, 0.6 + noise(random)));
    }
    std::vector<Tracker::Assignment> found;
    tracker.update(i * 100'000'000LL, boxes, {}, found);
    speed = std::max(0.0, speed - 0.4);
    x += kFrame * speed;
    for (const Tracker::Assignment& one : found) {
      if (!one.track || i < 45) continue;
      EXPECT_FALSE(one.track->moving) << "seed " << kSeed << ", frame " << i;
      ++count;
    }
    if (i == 45) stopped = tracker.sensor().translation().x();
  }
  ASSERT_GT(count, 600U);
  EXPECT_NEAR(tracker.sensor().translation().x() - stopped, 0, 0.05);
}

}  // namespace
}  // namespace pcl_bv::detail
