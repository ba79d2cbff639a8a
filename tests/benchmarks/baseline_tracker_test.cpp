// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The tracker to compare with, the overlap of boxes, and the simulated detector.

#include "baseline_tracker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "detections.h"

namespace pcl_bv::bench {
namespace {

constexpr double kPi = 3.14159265358979323846;

DetectedBox box(double x, double y, double yaw = 0) {
  return {{{x, y}, yaw, 4, 2}, 0, 1.5};
}

TEST(GroundIou, IsTheSharedAreaOfTheUnion) {
  const GroundBox a{{0, 0}, 0, 4, 2};
  EXPECT_DOUBLE_EQ(ground_iou(a, a), 1);
  EXPECT_DOUBLE_EQ(ground_iou(a, {{2, 0}, 0, 4, 2}), 1.0 / 3);
  EXPECT_DOUBLE_EQ(ground_iou(a, {{0, 0}, 0, 2, 1}), 0.25);             // inside
  EXPECT_NEAR(ground_iou(a, {{0, 0}, kPi / 2, 4, 2}), 1.0 / 3, 1e-12);  // a cross
  EXPECT_NEAR(ground_iou(a, {{0, 0}, kPi, 4, 2}), 1, 1e-12);
  EXPECT_EQ(ground_iou(a, {{5, 0}, 0, 4, 2}), 0);
  EXPECT_EQ(ground_iou(a, {{0, 0}, 0, 0, 0}), 0);
  // A square and the same one turned by 45 degrees share a regular octagon.
  const double octagon = 2 * (std::sqrt(2.0) - 1);
  EXPECT_NEAR(ground_iou({{3, 4}, 0.3, 1, 1}, {{3, 4}, 0.3 + kPi / 4, 1, 1}), octagon / (2 - octagon), 1e-12);
}

TEST(GroundIou, IsSymmetric) {
  for (int i = 0; i < 50; ++i) {
    const GroundBox a{{0, 0}, 0.1 * i, 4, 2}, b{{0.03 * i, 1}, 0.37 * i, 3, 1};
    EXPECT_NEAR(ground_iou(a, b), ground_iou(b, a), 1e-12);
  }
}

TEST(BoxIou, AlsoCountsTheHeight) {
  DetectedBox high = box(0, 0);
  high.low = 0.75;
  high.high = 2.25;
  EXPECT_NEAR(box_iou(box(0, 0), box(0, 0)), 1, 1e-12);
  EXPECT_NEAR(box_iou(box(0, 0), high), 1.0 / 3, 1e-12);
  high.low = 1.5;
  EXPECT_EQ(box_iou(box(0, 0), high), 0);
}

TEST(BaselineTracker, GivesAnIdAtTheThirdDetectionAndKeepsIt) {
  BaselineTracker tracker({});
  for (int frame = 0; frame < 10; ++frame) {
    const auto ids = tracker.update({box(1.0 * frame, 0), box(0, 20)});
    ASSERT_EQ(ids.size(), 2U);
    EXPECT_EQ(ids[0].has_value(), frame >= 2);
    if (frame >= 2) {
      EXPECT_EQ(ids[0], 0U);
      EXPECT_EQ(ids[1], 1U);
    }
  }
}

TEST(BaselineTracker, PredictsAConstantVelocity) {
  BaselineTracker tracker({});
  for (int frame = 0; frame < 8; ++frame)
    tracker.update({box(3.0 * frame, 0)});
  tracker.update({});
  // Two steps of 3 m after the last detection, its box of 4 m overlaps the prediction only.
  EXPECT_EQ(tracker.update({box(27, 0)})[0], 0U);
}

TEST(BaselineTracker, DeletesATrackAfterTwoFramesWithoutADetection) {
  for (const int gap : {1, 2}) {
    BaselineTracker tracker({});
    for (int frame = 0; frame < 5; ++frame)
      tracker.update({box(0, 0)});
    for (int frame = 0; frame < gap; ++frame)
      tracker.update({});
    EXPECT_EQ(tracker.update({box(0, 0)})[0].has_value(), gap < 2);
  }
}

TEST(BaselineTracker, ADetectionThatPointsBackwardsIsTheSameObject) {
  BaselineTracker tracker({});
  for (int frame = 0; frame < 8; ++frame) {
    const auto ids = tracker.update({box(0, 0, frame % 2 == 0 ? 0.1 : 0.1 + kPi)});
    if (frame >= 2) {
      EXPECT_EQ(ids[0], 0U);
    }
  }
}

TEST(Detector, MakesMissesAndFalseAlarmsAtTheStatedRates) {
  std::vector<RuralRoadObject> objects(20);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    objects[i].id = static_cast<std::uint32_t>(i + 1);
    objects[i].center = {2.0 * static_cast<double>(i), 5, -1};
    objects[i].axes = {{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}};
    objects[i].half_extents = {2, 1, 0.75};
  }
  Detector detector({}, 1), again({}, 1);
  double found = 0, alarms = 0, offset = 0;
  constexpr int frames = 2000;
  for (int frame = 0; frame < frames; ++frame) {
    const std::vector<Detection> detections = detector.detect(objects);
    EXPECT_EQ(again.detect(objects).size(), detections.size());
    for (const Detection& one : detections) {
      if (!one.object) {
        ++alarms;
        continue;
      }
      ++found;
      offset += one.box.base.center.x() - 2.0 * (*one.object - 1);
      EXPECT_NEAR(one.box.base.yaw, kPi / 2, 0.6);
      EXPECT_GT(one.box.base.length, one.box.base.width);
    }
  }
  // A gap begins in 2 % of the frames that are in none, and has 2.5 further frames on average.
  EXPECT_NEAR(found / (20.0 * frames), 0.98 * 0.9 / (1 + 0.02 * 2.5), 0.01);
  EXPECT_NEAR(alarms / frames, 3, 0.15);
  EXPECT_NEAR(offset / found, 0, 0.01);
}

}  // namespace
}  // namespace pcl_bv::bench
