// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// How far vehicles reach of which the sensor, which is at the origin, sees a part.

#include "pipeline/track/vehicle_extent.h"

#include <gtest/gtest.h>

#include <vector>

#include "pipeline/track/box_filter.h"

namespace pcl_bv::detail {
namespace {

const Eigen::Vector3d kStands = Eigen::Vector3d::Zero();

ObjectSlabs visible(double x_low, double x_high, double y_low, double y_high, double height = 1.4) {
  return {Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero(), {x_low, y_low, 0}, {x_high, y_high, height}};
}

ObjectSlabs extended(ObjectSlabs seen, const Eigen::Vector3d& velocity,
                     const std::vector<Aabb>& others = {}) {
  std::vector<Aabb> boxes{{seen.low, seen.high}};
  boxes.insert(boxes.end(), others.begin(), others.end());
  extend_vehicle(seen, velocity, {&Viewpoints::single(), &boxes, 0});
  return seen;
}

void expect_plan(const ObjectSlabs& box, double x_low, double x_high, double y_low, double y_high) {
  EXPECT_NEAR(box.low.x(), x_low, 1e-12);
  EXPECT_NEAR(box.high.x(), x_high, 1e-12);
  EXPECT_NEAR(box.low.y(), y_low, 1e-12);
  EXPECT_NEAR(box.high.y(), y_high, 1e-12);
}

TEST(VehicleExtent, ARearHasTheLengthOfASmallCarBehindIt) {
  expect_plan(extended(visible(20, 20.3, -0.9, 0.9), kStands), 20, 23.9, -0.9, 0.9);
}

TEST(VehicleExtent, ASideHasTheWidthOfASmallCarBehindIt) {
  expect_plan(extended(visible(20, 20.3, -2, 2), kStands), 20, 21.6, -2, 2);
}

TEST(VehicleExtent, ASideContinuesBehindTheObjectThatOccludesItsEnd) {
  const ObjectSlabs part = visible(20, 20.3, -0.9, 0.9);
  const Aabb left{{10, 0.48, 0}, {11, 2, 1.5}}, right{{10, -2, 0}, {11, -0.48, 1.5}};
  expect_plan(extended(part, kStands, {left}), 20, 21.6, -0.9, 3);
  expect_plan(extended(part, kStands, {right}), 20, 21.6, -3, 0.9);
  expect_plan(extended(part, kStands, {left, right}), 20, 21.6, -1.95, 1.95);
  const Aabb low{{10, 0.48, 0}, {11, 2, 0.3}};  // the sensor sees over it
  expect_plan(extended(part, kStands, {low}), 20, 23.9, -0.9, 0.9);
}

TEST(VehicleExtent, AMovingVehicleIsLongInItsDirection) {
  const ObjectSlabs part = visible(20, 21.5, 5, 6.5, 0.7);
  expect_plan(extended(part, {0, 5, 0}), 20, 21.6, 5, 8.9);
  expect_plan(extended(part, {-5, 0, 0}), 20, 23.9, 5, 6.6);
  expect_plan(extended(visible(20, 20.3, -1.5, 1.5), {0, 5, 0}), 20, 21.6, -1.95, 1.95);  // a side
}

TEST(VehicleExtent, WhatIsNoSideOfAVehicleStaysAsItWasSeen) {
  const ObjectSlabs person = visible(20, 20.5, 0, 0.6, 1.7), kerb = visible(20, 20.3, 0, 3, 0.2),
                    wall = visible(20, 20.3, 0, 7, 2), truck = visible(20, 25, 0, 3, 2),
                    post = visible(20, 20.3, 0, 1.8, 3);
  for (const ObjectSlabs& seen : {person, kerb, wall, truck, post}) {
    const ObjectSlabs same = extended(seen, kStands);
    EXPECT_EQ(same.low, seen.low);
    EXPECT_EQ(same.high, seen.high);
  }
  const ObjectSlabs cyclist = visible(20, 20.6, 0, 1.8, 1.7), same = extended(cyclist, {0, 5, 0});
  EXPECT_EQ(same.low, cyclist.low);
  EXPECT_EQ(same.high, cyclist.high);
}

TEST(VehicleExtent, IsThatOfAGrowingBoxInAnyFrame) {
  for (const double degrees : {0.0, 33.0, 90.0, 200.0}) {
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(degrees * 0.017453292519943295, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    std::vector<double> xyz;
    for (const double x : {20.0, 20.3})
      for (const double y : {-0.9, 0.9})
        for (const double z : {0.0, 1.4}) {
          const Eigen::Vector3d p = turn * Eigen::Vector3d(x, y, z);
          xyz.insert(xyz.end(), p.data(), p.data() + 3);
        }
    BoxFilter filter;
    BoxState state;
    const Obb seen(turn * Eigen::Vector3d(20.15, 0, 0.7), turn, {0.15, 0.9, 0.7});
    const Obb box = filter.smoothed(filter.align_axes(seen, state),
                                    PointView::of(xyz.data(), 24, xyz.size() / 3), state, false, true);
    const Eigen::Vector3d expected = turn * Eigen::Vector3d(21.95, 0, 0.7);
    EXPECT_LT((box.center() - expected).norm(), 1e-9) << degrees;
    EXPECT_NEAR(box.half_extents().head<2>().maxCoeff(), 1.95, 1e-9) << degrees;
  }
}

}  // namespace
}  // namespace pcl_bv::detail
