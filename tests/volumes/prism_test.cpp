// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Claims of Prism beyond those of every volume (round_volumes_test.cpp, pairs_test.cpp), and of the outlines
// that rounding errors leave room for.
#include "pcl_bv/volumes/prism.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "obbs.h"
#include "pcl_bv/volumes/planar_hull.h"
#include "round_volumes.h"

namespace pcl_bv::detail {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::exact;
using testing::inside;
using testing::prism_around;
using testing::Random;

const Eigen::Matrix3d kAxes = Eigen::Matrix3d::Identity();

Prism triangle() {
  return {kAxes, {{0, 0}, {4, 0}, {0, 3}}, 1, 3};
}

TEST(Prism, OfATriangleHasItsMeasures) {
  const Prism prism = triangle();
  EXPECT_DOUBLE_EQ(prism.footprint_area(), 6);
  EXPECT_DOUBLE_EQ(prism.volume(), 12);
  EXPECT_DOUBLE_EQ(prism.surface_area(), 2 * 6 + 12 * 2);
  EXPECT_TRUE(prism.center().isApprox(Vector3d(4.0 / 3, 1, 2)));
  EXPECT_EQ(prism.aabb(), Aabb({0, 0, 1}, {4, 3, 3}));
  EXPECT_EQ(prism.support({1, 0, -1}), Vector3d(4, 0, 1));
  EXPECT_DOUBLE_EQ(prism.distance({-3, 1, 2}), 3);
  EXPECT_DOUBLE_EQ(prism.distance({-3, 1, 7}), 5);
  EXPECT_DOUBLE_EQ(prism.distance({4, 3, 2}), 12.0 / 5);
  EXPECT_EQ(prism.distance({1, 1, 2}), 0);
  EXPECT_EQ(prism.footprint(), (std::vector<Vector3d>{{0, 0, 1}, {4, 0, 1}, {0, 3, 1}}));
  EXPECT_EQ(prism.mesh().vertices.size(), 6u);
  EXPECT_EQ(prism.mesh().faces.size(), 5u);
}

// The area is 6 * 2^-1328, which is 0 as a double.
TEST(Prism, HasItsVolumeEvenIfItsAreaVanishes) {
  const double size = 0x1p-664, height = 0x1p332;
  const Prism prism(kAxes, {{0, 0}, {3 * size, 0}, {0, 4 * size}}, 0, 2 * height);
  EXPECT_EQ(prism.volume(), std::ldexp(12, -996));
}

TEST(Prism, IsHitByRaysWhereItsFacesAre) {
  const auto hit = triangle().intersect({-1, 1, 2}, {1, 0, 0});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->enter, 1, 1e-12);
  EXPECT_NEAR(hit->exit, 1 + 8.0 / 3, 1e-12);
  EXPECT_FALSE(triangle().intersect({-1, 1, 4}, {1, 0, 0}));
  EXPECT_FALSE(triangle().intersect({-1, 4, 2}, {1, 0, 0}));
}

TEST(Prism, OfASegmentOrAPointIsFlat) {
  const Prism wall(kAxes, {{0, 0}, {3, 4}}, 0, 2), pole(kAxes, {{1, 2}}, 0, 2);
  EXPECT_EQ(wall.volume(), 0);
  EXPECT_DOUBLE_EQ(wall.surface_area(), 2 * 5 * 2);
  EXPECT_TRUE(wall.contains({1.5, 2, 1}));
  EXPECT_FALSE(wall.contains({1.5, 2.0001, 1}));
  EXPECT_FALSE(wall.contains({6, 8, 1})) << "on the line, beyond the segment";
  EXPECT_FALSE(wall.intersect({6, 8, -1}, {0, 0, 1}));
  EXPECT_DOUBLE_EQ(wall.distance({6, 8, 1}), 5);
  EXPECT_EQ(pole.surface_area(), 0);
  EXPECT_TRUE(pole.contains({1, 2, 2}));
  EXPECT_FALSE(pole.contains({1, 2.0001, 2}));
  EXPECT_EQ(pole.center(), Vector3d(1, 2, 1));
  EXPECT_EQ(pole.aabb(), Aabb({1, 2, 0}, {1, 2, 2}));
}

TEST(Prism, RefusesInvalidOutlines) {
  using Outline = std::vector<Vector2d>;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Outline& wrong :
       {Outline{{0, 0}, {0, 1}, {1, 0}}, Outline{{0, 0}, {1, 0}, {2, 0}}, Outline{{0, 0}, {0, 0}},
        Outline{{nan, 0}}, Outline{{1e200, 0}}, Outline{{0, 0}, {2, 1}, {0, 2}, {2, 0}, {1, 3}}}) {
    EXPECT_THROW(Prism(kAxes, wrong, 0, 1), std::invalid_argument);
  }
  EXPECT_THROW(Prism(kAxes, {{0, 0}}, nan, 1), std::invalid_argument);
  EXPECT_THROW(Prism(-kAxes, {{0, 0}}, 0, 1), std::invalid_argument) << "left-handed";
  EXPECT_THROW(Prism(2 * kAxes, {{0, 0}}, 0, 1), std::invalid_argument);
  EXPECT_TRUE(Prism(kAxes, {}, 0, 1).empty());
  EXPECT_TRUE(Prism(kAxes, {{0, 0}}, 1, 0).empty());
  EXPECT_NO_THROW(Prism(kAxes, {{1, 1}, {0, 0}, {1, 0}}, 0, 0)) << "any corner may be the first";
}

TEST(Prism, HasNoNegativeZero) {
  const Prism prism(-0.0 * kAxes + kAxes, {{-0.0, 0}, {1, -0.0}, {0, 1}}, -0.0, 1);
  EXPECT_FALSE(std::signbit(prism.low()));
  EXPECT_FALSE(std::signbit(prism.outline()[0].x()) || std::signbit(prism.outline()[1].y()));
}

TEST(Prism, ContainsAllPointsItIsMadeAroundExactly) {
  Random random(1);
  for (const testing::Scale& scale : testing::scales()) {
    for (int i = 0; i < 60; ++i) {
      const Eigen::Matrix3d axes = orthonormal_axes(random.isometry(1).linear());
      const testing::Span span = testing::spans()[static_cast<std::size_t>(i % 4)];
      const std::vector<Vector3d> points = random.cloud(scale, span, 1 + static_cast<std::size_t>(i));
      const Prism prism = prism_around(points, i % 3 == 0 ? kAxes : axes);
      for (const Vector3d& p : points) {
        ASSERT_TRUE(inside(prism, exact(p))) << scale.name << ", seed 1, " << i;
        ASSERT_TRUE(prism.contains(p)) << scale.name << ", seed 1, " << i;
      }
    }
  }
}

TEST(Prism, MovedByAReflectionContainsItsPoints) {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const std::vector<Vector3d> points = random.cloud({"", 10, 1}, testing::Span::solid, 20);
    Eigen::Isometry3d mirror = random.isometry(1);
    mirror.linear().col(i % 3) *= -1;
    const Prism moved =
        prism_around(points, orthonormal_axes(random.isometry(1).linear())).transformed(mirror);
    for (const Vector3d& p : points)
      ASSERT_TRUE(inside(moved, testing::image(mirror, exact(p)))) << "seed 2, " << i;
  }
}

TEST(Prism, ShiftedByDoublesKeepsItsOutline) {
  const Eigen::Isometry3d shift(Eigen::Translation3d(8, -16, 0.5));
  EXPECT_EQ(triangle().transformed(shift), Prism(kAxes, {{8, -16}, {12, -16}, {8, -13}}, 1.5, 3.5));
}

// Whether the polygon contains the point, exactly.
bool is_in(const std::vector<Vector2d>& polygon, const Vector2d& p) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    if (orientation(polygon[i], polygon[(i + 1) % polygon.size()], p) < 0) return false;
  }
  return true;
}

TEST(OutlineAround, ContainsAllBoxesAndHasHardlyMoreCornersThanTheirHull) {
  Random random(3);
  for (int i = 0; i < 500; ++i) {
    const double offset = i % 2 == 0 ? 0 : 5e6;
    std::vector<PlaneBox> boxes;
    std::vector<Vector2d> points;
    for (int k = 0; k < 5 + i % 50; ++k) {
      points.emplace_back(offset + random.uniform(-1, 1), random.uniform(-1, 1));
      boxes.push_back({points.back(), points.back().array() + 1e-9});
    }
    const std::vector<Vector2d> outline = outline_around(boxes);
    EXPECT_EQ(planar_hull(outline).size(), outline.size());
    for (const PlaneBox& box : boxes) {
      for (const Vector2d& corner :
           {box.low, box.high, Vector2d(box.low.x(), box.high.y()), Vector2d(box.high.x(), box.low.y())})
        ASSERT_TRUE(is_in(outline, corner)) << "seed 3, " << i;
    }
    EXPECT_LE(outline.size(), planar_hull(points).size() + 6) << "seed 3, " << i;
  }
}

TEST(OutlineAround, PointsIsTheirHull) {
  EXPECT_EQ(outline_around({{{2, 0}, {2, 0}}, {{0, 0}, {0, 0}}, {{1, 0}, {1, 0}}, {{1, 1}, {1, 1}}}),
            (std::vector<Vector2d>{{0, 0}, {2, 0}, {1, 1}}));
}

}  // namespace
}  // namespace pcl_bv::detail
