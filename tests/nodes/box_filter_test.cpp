// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Boxes of a track over time.

#include "pipeline/track/box_filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "pcl_bv/fitting/fit.h"

namespace pcl_bv::detail {
namespace {

constexpr double degree = 3.14159265358979323846 / 180;

Eigen::Matrix3d turn(double degrees) {
  return Eigen::AngleAxisd(degrees * degree, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

Obb upright_box(double degrees, double length, double width, const Eigen::Vector3d& at = {10, 4, 0}) {
  return {at, turn(degrees), {length / 2, width / 2, 0.75}};
}

double yaw_of(const Obb& box) {
  return std::atan2(box.axes()(1, 0), box.axes()(0, 0)) / degree;
}

BoxState going(double degrees, double speed) {
  return {Pose::Identity(), speed * turn(degrees).col(0), true};
}

// Points of a block of 4 x 2 x 1.5 m at (10, 4, 0), turned by so much.
std::vector<float> block(double degrees, std::mt19937& random, double length = 4) {
  std::vector<float> xyz;
  for (int i = 0; i < 200; ++i) {
    Eigen::Vector3d p;
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = static_cast<double>(random()) / 4294967296.0 - 0.5;
    p = turn(degrees) * Eigen::Vector3d(length * p.x(), 2 * p.y(), 1.5 * p.z()) + Eigen::Vector3d(10, 4, 0);
    for (int axis = 0; axis < 3; ++axis)
      xyz.push_back(static_cast<float>(p[axis]));
  }
  return xyz;
}

PointView view(const std::vector<float>& xyz) {
  return PointView::of(xyz.data(), 12, xyz.size() / 3);
}

TEST(BoxFilter, TheFrontComesToBeWhereTheObjectGoesAndStaysThereWhenItStands) {
  for (const double heading : {0.0, 90.0, 180.0, -90.0}) {
    BoxFilter filter;
    Obb box;
    for (int i = 0; i < 10; ++i)
      box = filter.align_axes(upright_box(0, 4, 2), going(heading, 5));
    EXPECT_NEAR(std::abs(std::remainder(yaw_of(box) - heading, 360)), 0, 1e-9) << heading;
    const int along = std::abs(heading) == 90 ? 1 : 0;
    EXPECT_EQ(box.half_extents()[along], 2) << heading;
    for (int i = 0; i < 20; ++i)
      box = filter.align_axes(upright_box(0, 4, 2), {});
    EXPECT_NEAR(std::abs(std::remainder(yaw_of(box) - heading, 360)), 0, 1e-9) << heading;
  }
}

TEST(BoxFilter, OneFrameOfAWrongVelocityDoesNotTurnTheFront) {
  BoxFilter filter;
  Obb box;
  for (int i = 0; i < 10; ++i)
    filter.align_axes(upright_box(0, 4, 2), going(0, 5));
  for (int i = 0; i < 2; ++i) {
    box = filter.align_axes(upright_box(0, 4, 2), going(180, 5));
    EXPECT_NEAR(yaw_of(box), 0, 1e-9);
  }
}

TEST(BoxFilter, TheFrontStaysWhereItIsWhileTheSensorTurns) {
  BoxFilter filter;
  Obb box = filter.align_axes(upright_box(30, 3, 3), {});
  for (int i = 1; i < 60; ++i) {  // 10 degrees a frame; a square, which the fit names anew in each
    BoxState state;
    state.sensor.linear() = turn(10 * i);
    box = filter.align_axes(upright_box(30 - 10 * i + 90 * (i % 4), 3, 3), state);
    ASSERT_NEAR(std::remainder(yaw_of(box) + 10 * i - 30, 360), 0, 1e-9) << i;
  }
}

TEST(BoxFilter, ASmoothTurnIsTheMeanOfAnglesModulo90) {
  std::mt19937 random(5);
  BoxFilter filter;
  double worst = 0, raw = 0;
  for (int i = 0; i < 100; ++i) {
    const std::vector<float> xyz = block(43, random);
    const double noise = 12 * (static_cast<double>(random()) / 4294967296.0 - 0.5) + (i % 3 == 0 ? 90 : 0);
    const Obb box =
        filter.smoothed(filter.align_axes(upright_box(43 + noise, 4, 4), {}), view(xyz), {}, true, false);
    if (i < 20) continue;
    worst = std::max(worst, std::abs(std::remainder(yaw_of(box) - 43, 90)));
    raw = std::max(raw, std::abs(std::remainder(noise, 90)));
  }
  EXPECT_GT(raw, 5);
  EXPECT_LT(worst, 2);
}

TEST(BoxFilter, ASmoothYawFollowsTheDirectionOfMotion) {
  std::mt19937 random(8);
  for (const double speed : {0.5, 8.0}) {
    BoxFilter filter;
    Obb box;
    for (int i = 0; i < 30; ++i) {
      const std::vector<float> xyz = block(20, random);
      const BoxState state = going(20, speed);
      box = filter.smoothed(filter.align_axes(upright_box(28, 4, 2), state), view(xyz), state, true, false);
    }
    EXPECT_NEAR(yaw_of(box), speed > 2 ? 24 : 28, 0.1) << speed;  // the fit is wrong by 8 degrees
  }
}

// Fits that are wrong by 40 degrees, then by 80, lead names that follow the fit round by a quarter.
TEST(BoxFilter, ASmoothBoxKeepsItsFrontWhereFitsAreWrongForAFewFrames) {
  std::mt19937 random(6);
  BoxFilter filter;
  for (int i = 0; i < 60; ++i) {
    const std::vector<float> xyz = block(10, random);
    const double wrong = i < 30 ? 0 : i < 33 ? 40 : i < 36 ? 80 : 0;
    const Obb box =
        filter.smoothed(filter.align_axes(upright_box(10 + wrong, 4, 2), {}), view(xyz), {}, true, false);
    EXPECT_NEAR(yaw_of(box), 10, 15) << i;
  }
}

TEST(BoxFilter, EveryPointIsInsideHoweverTheBoxIsSteadied) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    std::mt19937 random(seed);
    BoxFilter filter;
    for (int i = 0; i < 20; ++i) {
      const double yaw = 9.0 * i + 5 * static_cast<double>(random() % 7);
      const std::vector<float> xyz = block(yaw, random, 1 + static_cast<double>(random() % 5));
      BoxState state;
      state.moving = random() % 2 == 0;
      state.sensor.linear() = turn(3 * i);
      const Obb box = filter.smoothed(filter.align_axes(upright_box(yaw + 7, 4, 2), state), view(xyz), state,
                                      seed % 2 == 0, seed % 3 != 0);
      for (std::size_t p = 0; p < xyz.size(); p += 3)
        ASSERT_TRUE(box.contains({xyz[p], xyz[p + 1], xyz[p + 2]})) << "seed " << seed << " frame " << i;
    }
  }
}

TEST(BoxFilter, WhatHasBeenSeenStaysAwayFromTheSensor) {
  std::mt19937 random(3);
  BoxFilter filter;
  const std::vector<float> whole = block(0, random), part = [&] {
    std::vector<float> near;  // the nearer half: x below 10
    for (std::size_t p = 0; p < whole.size(); p += 3)
      if (whole[p] < 10) near.insert(near.end(), {whole[p], whole[p + 1], whole[p + 2]});
    return near;
  }();
  Obb box;
  for (int i = 0; i < 10; ++i)
    box = filter.smoothed(upright_box(0, 4, 2), view(whole), {}, false, true);
  const double length = 2 * box.half_extents().x(), near = box.center().x() - length / 2;
  EXPECT_NEAR(length, 4, 0.1);
  box = filter.smoothed(upright_box(0, 2, 2), view(part), {}, false, true);
  EXPECT_NEAR(2 * box.half_extents().x(), length, 1e-9);
  EXPECT_NEAR(box.center().x() - box.half_extents().x(), near, 1e-9);
}

TEST(BoxFilter, AFrameInWhichTwoObjectsAreOneDoesNotStay) {
  std::mt19937 random(4);
  BoxFilter filter;
  Obb box;
  for (int i = 0; i < 12; ++i) {
    const std::vector<float> xyz = block(0, random, i == 10 ? 14 : 4);
    box = filter.smoothed(upright_box(0, 4, 2), view(xyz), {}, false, true);
  }
  EXPECT_LT(2 * box.half_extents().x(), 4.2);
}

TEST(BoxFilter, EmptyAndLyingBoxesStayAsTheyAre) {
  BoxFilter filter;
  const std::vector<float> none;
  EXPECT_TRUE(filter.smoothed(filter.align_axes(Obb(), {}), view(none), {}, true, true).empty());
  const Obb box = upright_box(20, 4, 2);
  EXPECT_EQ(filter.smoothed(box, view(none), {}, true, true), box);
  const Eigen::Matrix3d lying = Eigen::AngleAxisd(1, Eigen::Vector3d::UnitX()).toRotationMatrix();
  const Obb slant({1, 2, 3}, lying, {3, 2, 1});
  std::mt19937 random(6);
  const std::vector<float> some = block(0, random);
  BoxFilter of_any_axes(false);
  EXPECT_EQ(of_any_axes.smoothed(slant, view(some), {}, true, true), slant);
  EXPECT_EQ(of_any_axes.smoothed(box, view(some), {}, true, true), box) << "upright by chance";
}

// Points of a block of this size, and of its nearer half.
std::vector<float> half_block(const Eigen::Matrix3d& lift, const Eigen::Vector3d& size, bool whole) {
  std::vector<float> xyz;
  for (int i = 0; i <= 10; ++i)
    for (int j = 0; j <= 10; ++j)
      for (int k = 0; k <= 10; ++k) {
        if (!whole && i > 5) continue;
        const Eigen::Vector3d p =
            lift * (Eigen::Vector3d(10, 4, 0) + size.cwiseProduct(Eigen::Vector3d(i - 5, j - 5, k - 5) / 10));
        for (const double c : p)
          xyz.push_back(static_cast<float>(c));
      }
  return xyz;
}

// Whichever extent is the largest and whichever way is up: poles, slabs, square bases.
TEST(BoxFilter, BoxesOfEveryUprightMethodGrowForAnyUp) {
  for (const ObbMethod method : {ObbMethod::yaw, ObbMethod::lshape})
    for (const Eigen::Vector3d& up :
         {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(0, -1, 0),
          Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(1, 2, 3)})
      for (const Eigen::Vector3d& size : {Eigen::Vector3d(1, 0.6, 6), Eigen::Vector3d(4, 3, 0.5),
                                          Eigen::Vector3d(4, 1, 2), Eigen::Vector3d(2, 2, 2)}) {
        const Eigen::Matrix3d lift =
            Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), up).toRotationMatrix();
        BoxFilter filter;
        BoxState state;
        state.extends_vehicles = false;
        Obb box, fitted;
        for (int frame = 0; frame < 8; ++frame) {
          const std::vector<float> xyz = half_block(lift, size, frame < 7);
          fitted = *fit_obb(view(xyz), {method, up});
          box = filter.smoothed(filter.align_axes(fitted, {}), view(xyz), state, true, true);
        }
        EXPECT_NE(box, fitted) << "the filter left it as it was";
        EXPECT_LE((box.axis(2) - up.normalized()).norm(), 1e-15);
        const Eigen::Vector3d sorted(std::max(size.x(), size.y()), std::min(size.x(), size.y()), size.z());
        EXPECT_LE((2 * box.half_extents() - sorted).norm(), 0.1) << 2 * box.half_extents().transpose();
      }
}

TEST(BoxFilter, AMergedClusterChangesNeitherSizesNorTurn) {
  std::mt19937 random(7);
  BoxFilter filter;
  const auto steadied = [&](double degrees, double length, const BoxState& state) {
    const std::vector<float> xyz = block(degrees, random, length);
    return filter.smoothed(filter.align_axes(upright_box(degrees, length, 2), state), view(xyz), state, true,
                           true);
  };
  for (int i = 0; i < 10; ++i)
    steadied(0, 4, {});
  BoxState merged;
  merged.merged = true;
  for (int i = 0; i < 20; ++i) {
    const Obb box = steadied(30, 9, merged);
    EXPECT_NEAR(yaw_of(box), 0, 1e-9) << "turned by the mean before";
    EXPECT_GT(2 * box.half_extents().x(), 7) << "but around all points";
  }
  EXPECT_LT(2 * steadied(0, 4, {}).half_extents().x(), 4.01);
}

TEST(BoxFilter, ASeparatedObjectLearnsItsSizesAnew) {
  std::mt19937 random(8);
  BoxFilter filter;
  Obb box;
  for (int i = 0; i < 12; ++i) {
    BoxState state;
    state.separated = i == 8;
    const std::vector<float> xyz = block(0, random, i < 6 ? 9 : 4);
    box = filter.smoothed(upright_box(0, 4, 2), view(xyz), state, false, true);
    EXPECT_EQ(2 * box.half_extents().x() > 8, i < 8) << i;
  }
}

}  // namespace
}  // namespace pcl_bv::detail
