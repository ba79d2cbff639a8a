// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Claims of fit_prism() with a concave outline, for points and lengths at the limits.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "concave_clouds.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/volumes/simple_polygon.h"

namespace pcl_bv::detail {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using test::cloud_of;
using test::expect_sound;
using test::TestCloud;

TEST(ConcavePrism, IsTheConvexOneIfRoundingRemovesItsOnlyBay) {
  for (int i = 0; i < 600; ++i) {
    const double depth = (1 + i % 8) * 0x1p-51, angle = 0.01 * i;
    const std::vector<Vector2d> corners = {{0, 0}, {4, 0}, {4, 4}, {2, 4 - depth}, {0, 4}};
    std::vector<Vector3d> points;
    for (const Vector2d& corner : corners) {
      const Vector2d p = Eigen::Rotation2Dd(angle) * corner;
      points.emplace_back(p.x(), p.y(), 0.1 * corner.x());
    }
    const TestCloud<double> cloud = cloud_of<double>(points);
    const Vector3d up(0.1, -0.2, 1);
    const Prism prism = *fit_prism(cloud.view(), {up, 1});
    ASSERT_EQ(prism.is_convex(), is_strictly_convex(prism.outline())) << i;
    expect_sound(cloud, up, 1, "turn " + std::to_string(i));
  }
}

TEST(ConcavePrism, OfPointsNearlyOnALineIsEnclosed) {
  std::vector<Vector3d> points = {{30, 10, 0}, {0, 30, 0}};
  for (int i = 0; i <= 3000; ++i) {
    const double x = 0.01 * i;
    points.emplace_back(x, x / 3 + 0x1p-50 * (i % 7), 0);
  }
  expect_sound(cloud_of<double>(points), Vector3d::UnitZ(), 5, "a line");
}

TEST(ConcavePrism, OfPointsExactlyOnTwoWallsKeepsItsHull) {
  for (const Vector2d& corner : {Vector2d(0, 0), Vector2d(-40, -80), Vector2d(40, -80), Vector2d(40, 80)}) {
    std::vector<Vector3d> points;
    for (int i = 0; i <= 40; ++i) {
      points.emplace_back(corner.x() + 0.25 * i, corner.y(), 1);
      points.emplace_back(corner.x(), corner.y() + 0.25 * i, 2);
    }
    const Prism prism = *fit_prism(cloud_of<double>(points).view(), {Vector3d::UnitZ(), 1});
    const std::vector<Vector2d> hull = {corner, corner + Vector2d(10, 0), corner + Vector2d(0, 10)};
    EXPECT_EQ(prism.outline(), hull) << corner.transpose();
  }
}

// Sides shorter than the length are not refined. The points in their middle see the long sides at the widest
// angle; as corners they would make the outline touch itself.
TEST(ConcavePrism, HasNoCornerInsideASideThatIsShorterThanTheLength) {
  for (const Vector2d& corner : {Vector2d(0, 0), Vector2d(-40, -80), Vector2d(40, -80), Vector2d(40, 80)}) {
    std::vector<Vector3d> points;
    for (const Vector2d& p : {Vector2d(0, 0), Vector2d(10, 0), Vector2d(10, 1.5), Vector2d(10, 3),
                              Vector2d(0, 3), Vector2d(0, 1.5)})
      points.emplace_back(corner.x() + p.x(), corner.y() + p.y(), 1);
    const Prism prism = *fit_prism(cloud_of<double>(points).view(), {Vector3d::UnitZ(), 5});
    EXPECT_EQ(prism.outline().size(), 4U) << corner.transpose();
    EXPECT_EQ(prism.footprint_area(), 30) << corner.transpose();
  }
}

TEST(ConcavePrism, OfCoordinatesNearTheSmallestDoublesIsEnclosed) {
  std::mt19937_64 random(10);
  for (const int exponent : {-540, -530, -515, -500}) {
    std::vector<Vector3d> points = test::hedge(random, 200);
    for (Vector3d& p : points)
      p *= std::ldexp(1.0, exponent);
    const double size = std::ldexp(1.0, exponent);
    const TestCloud<double> cloud = cloud_of<double>(points);
    const Prism prism = *fit_prism(cloud.view(), {Vector3d::UnitZ(), size});
    EXPECT_EQ(verify(prism, cloud.view()).outside, 0U) << exponent;
    const TestCloud<double> far = cloud_of<double>({Vector3d(20, 9, 1) * size});
    const double distance = verify(prism, far.view()).max_violation;
    EXPECT_TRUE(distance >= 0 && distance <= 30 * size) << exponent << ", " << distance;
  }
}

// 2^-900 is 1e-271, and its square is 0. 2^300 is 2e90.
TEST(ConcavePrism, HasTheSameOutlineAtEveryScale) {
  std::mt19937_64 random(5);
  const std::vector<Vector3d> points = test::hedge(random, 400);
  const Prism at_unit_scale = *fit_prism(cloud_of<double>(points).view(), {Vector3d::UnitZ(), 3});
  ASSERT_FALSE(at_unit_scale.is_convex());
  for (const int exponent : {-900, -600, -400, 300}) {
    const double scale = std::ldexp(1, exponent);
    std::vector<Vector3d> scaled = points;
    for (Vector3d& p : scaled)
      p *= scale;
    const Prism prism = *fit_prism(cloud_of<double>(scaled).view(), {Vector3d::UnitZ(), 3 * scale});
    std::vector<Vector2d> outline = at_unit_scale.outline();
    for (Vector2d& corner : outline)
      corner *= scale;
    EXPECT_EQ(prism.outline(), outline) << exponent;
  }
}

TEST(ConcavePrism, RefusesALengthThatIsNotAboveZero) {
  const TestCloud<float> cloud = test::gaussian<float>(30, 4);
  for (const double length : {0.0, -1e-9, std::numeric_limits<double>::quiet_NaN()}) {
    try {
      fit_prism(cloud.view(), {Vector3d::UnitZ(), length});
      ADD_FAILURE() << length;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find("concave_length"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("above 0"), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find("-0.0"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail
