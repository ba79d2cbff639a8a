// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The numbers of regions: their boxes hold the volumes and are larger by the margin alone, and what is round,
// flat or has planes is as the volume says.

#include "convex_region.h"

#include <gtest/gtest.h>

#include "any_volumes.h"
#include "inflated.h"
#include "vectors.h"

namespace pcl_bv::detail {
namespace {

using namespace testing;
using Weights = std::array<double, 3>;

// A box that may be unbounded.
struct Bounds {
  Vector3d low, high;

  Bounds(const Vector3d& least, const Vector3d& most) : low(least), high(most) {}
  Bounds(const Aabb& box) : low(box.min()), high(box.max()) {}
  bool operator==(const Bounds&) const = default;
};

Bounds box_of(const ConvexRegion& region) {
  return {vector(region.low), vector(region.high)};
}

bool is_within(const Bounds& inner, const Bounds& outer) {
  return (inner.low.array() >= outer.low.array()).all() && (inner.high.array() <= outer.high.array()).all();
}

// Replaces infinite sides by those of `finite`.
Bounds bounded(const Bounds& box, const Aabb& finite) {
  return {(box.low.array() == -kInfinity).select(finite.min(), box.low),
          (box.high.array() == kInfinity).select(finite.max(), box.high)};
}

bool has_planes(const AnyVolume& volume) {
  return std::holds_alternative<Kdop>(volume) || std::holds_alternative<Hull>(volume) ||
         std::holds_alternative<Prism>(volume);
}

TEST(ConvexRegion, HasABoxAroundTheVolumeLargerByTheMargin) {
  Random random(1);
  for (const double place : {0.0, 1e-3, 1.0, -1e6}) {
    for (const double size : {1e-3, 1.0, 1e6}) {
      for (const AnyVolume& volume : volumes_of_every_kind(random, {"", place, size})) {
        const Bounds box = box_of(convex_region(volume));
        const Aabb tight = aabb(volume);
        if (std::holds_alternative<Aabb>(volume)) {
          EXPECT_TRUE(box == Bounds(tight));
          continue;
        }
        const double most = std::max(tight.min().cwiseAbs().maxCoeff(), tight.max().cwiseAbs().maxCoeff());
        ASSERT_TRUE(is_within(tight, box)) << shape_name(volume);
        if (has_planes(volume)) {
          ASSERT_TRUE(is_within(bounded(box, tight), aabb(inflated(tight, 1e-11 * most))))
              << shape_name(volume);
        } else {
          ASSERT_TRUE(is_within(aabb(inflated(volume, 0.97 * 0x1p-40 * most)), box)) << shape_name(volume);
          ASSERT_TRUE(is_within(box, aabb(inflated(volume, 1.03 * 0x1p-40 * most)))) << shape_name(volume);
        }
      }
    }
  }
  EXPECT_TRUE(box_of(convex_region(Sphere({0, 0, 0}, 0))) ==
              Bounds(Vector3d::Constant(-0x1p-480), Vector3d::Constant(0x1p-480)));
}

TEST(ConvexRegion, OfRoundVolumesSaysWhatTheySay) {
  const Vector3d c(1, -2, 3);
  const Eigen::Matrix3d axes = Random(2).isometry(1).linear();
  const ConvexRegion ball = convex_region(Sphere(c, 2)), box = convex_region(Obb(c, axes, {3, 2, 0}));
  EXPECT_EQ(ball.shape, RegionShape::ball);
  EXPECT_EQ(ball.radius, 2);
  EXPECT_EQ(box.shape, RegionShape::slabs);
  EXPECT_EQ(box.slab, (Weights{3, 2, 0}));
  const ConvexRegion cylinder = convex_region(Cylinder(c, axes.col(0), 0.5, 3));
  EXPECT_EQ(cylinder.slab, (Weights{3, kInfinity, kInfinity}));
  EXPECT_EQ(cylinder.weight, (Weights{0, 1, 1}));
  EXPECT_EQ(cylinder.core, (Weights{0, 0, 0}));
  EXPECT_EQ(cylinder.radius, 0.5);
  const ConvexRegion flat = convex_region(Ellipsoid(c, axes, {0.5, 0.25, 0})),
                     point = convex_region(Ellipsoid(c, axes, {0, 0, 0}));
  EXPECT_EQ(flat.weight, (Weights{1, 2, kInfinity}));
  EXPECT_EQ(flat.radius, 0.5);
  EXPECT_EQ(point.weight, (Weights{kInfinity, kInfinity, kInfinity}));
  Eigen::Matrix3d turn;
  for (int i = 0; i < 3; ++i)
    turn.col(i) = Vector3d::Map(cylinder.axes[static_cast<std::size_t>(i)].data());
  EXPECT_EQ(turn.col(0), axes.col(0));
  EXPECT_LT((turn.transpose() * turn - Eigen::Matrix3d::Identity()).norm(), 1e-14);
  for (const ConvexRegion& region : {ball, box, cylinder, flat, point}) {
    EXPECT_EQ(vector(region.center), c);
    EXPECT_EQ(region.surface_error, 0);
  }
}

TEST(ConvexRegion, OfACapsuleIsItsEdgeAndWhatItsEndsAreRoundedBy) {
  for (const double length : {0.0, 0.5, 3.0}) {
    const Vector3d a(1, -2, 3), b(1, -2, 3 + length);
    const ConvexRegion capsule = convex_region(Capsule(a, b, 2));
    EXPECT_EQ(capsule.shape, RegionShape::rounded);
    EXPECT_EQ(vector(capsule.center), Vector3d(1, -2, 3 + 0.5 * length));
    EXPECT_EQ(capsule.core, (Weights{0.5 * length, 0, 0}));
    EXPECT_EQ(capsule.axes[0], (length > 0 ? Direction{0, 0, 1} : Direction{1, 0, 0}));
    EXPECT_EQ(capsule.weight, (Weights{1, 1, 1}));
    EXPECT_EQ(capsule.slab, (Weights{kInfinity, kInfinity, kInfinity}));
    EXPECT_EQ(capsule.radius, 2);
    EXPECT_EQ(capsule.surface_error, 0x1p-50 * (12 + length));
  }
}

// Planes as seen from the region's centre: within the doubt by exact arithmetic, which is that of the
// farthest.
void expect_planes(const ConvexRegion& region, const std::vector<HullPlane>& planes) {
  ASSERT_EQ(region.planes.size(), planes.size());
  double greatest = 0;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const HalfSpace& found = region.planes[i];
    const double length = planes[i].normal.norm();
    const Vector3d normal(found.x, found.y, found.z);
    EXPECT_LT((normal - planes[i].normal / length).norm(), 1e-15);
    const test::Rational off = test::Rational(found.limit) + dot(normal, exact(vector(region.center))) -
                               test::Rational(planes[i].offset / length);
    EXPECT_LE(abs(off), test::Rational(0.1 * region.surface_error));
    greatest = std::max(greatest, std::abs(planes[i].offset) / length);
  }
  EXPECT_NEAR(region.surface_error / (0x1p-45 * (greatest + vector(region.center).lpNorm<1>())), 1, 1e-9);
}

TEST(ConvexRegion, OfPlanesHasThemFromTheCentreWithTheirSurfaceError) {
  Random random(3);
  for (const double place : {0.0, 1.0, 1e6}) {
    for (const AnyVolume& volume : volumes_of_every_kind(random, {"", place, 1})) {
      if (const auto* hull = std::get_if<Hull>(&volume)) expect_planes(convex_region(*hull), hull->planes());
      if (const auto* kdop = std::get_if<Kdop>(&volume)) {
        std::vector<HullPlane> planes;
        for (std::size_t i = 0; i < kdop->size(); ++i) {
          planes.push_back({kdop->set()->direction(i), kdop->max(i)});
          planes.push_back({-kdop->set()->direction(i), -kdop->min(i)});
        }
        expect_planes(convex_region(*kdop), planes);
      }
    }
  }
}

TEST(ConvexRegion, OfPlanesAlongTheAxesHasTheirSides) {
  const double margin = 0x1p-480;
  const ConvexRegion cube = convex_region(testing::cube({-4, 0, 2}, 4));
  EXPECT_EQ(vector(cube.low), Vector3d(-4 - 0x1p-38, -margin, 2 - 0x1p-39));
  EXPECT_EQ(vector(cube.high), Vector3d(margin, 4 + 0x1p-38, 6 + 0x3p-39));
  // The corner of a cube: three sides along the axes, and a plane that closes it.
  const std::vector<Vector3d> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const double sign : {1.0, -1.0}) {
    std::vector<HullPlane> planes = {{sign * Vector3d(1, 1, 1), 1}};
    for (int k = 0; k < 3; ++k)
      planes.push_back({-sign * Vector3d::Unit(k), 0});
    const Bounds box = box_of(convex_region(Hull(corners, {}, planes, 3)));
    const Vector3d flat = sign > 0 ? box.low : Vector3d(-box.high),
                   far = sign > 0 ? box.high : Vector3d(-box.low);
    EXPECT_EQ(flat, Vector3d::Constant(-margin));
    EXPECT_EQ(far, Vector3d::Constant(kInfinity)) << "the plane across the corner is no side of a box";
  }
  const ConvexRegion half =
      convex_region(Hull({{0, 0, 0}}, {}, {{Vector3d(0, 0, 2), 4}, {Vector3d(0, 0, 1), 3}}, 0));
  EXPECT_EQ(vector(half.low), Vector3d::Constant(-kInfinity));
  EXPECT_EQ(vector(half.high), Vector3d(kInfinity, kInfinity, 2 + 0x1p-39));
}

TEST(ConvexRegion, IsUnboundedWhereNoSideIsAlongTheAxis) {
  for (int open = 0; open < 6; ++open) {
    std::vector<HullPlane> planes;
    for (int side = 0; side < 6; ++side) {
      const double sign = side % 2 == 0 ? 1 : -1;
      const Vector3d out = sign * Vector3d::Unit(side / 2), along = Vector3d::Unit((side / 2 + 1) % 3);
      if (side != open) {
        planes.push_back({out, 1});
      } else {
        planes.push_back({out + along, 2});
        planes.push_back({out - along, 2});
      }
    }
    const ConvexRegion region =
        convex_region(Hull({Vector3d::Constant(-1), Vector3d::Constant(1)}, {}, planes, 3));
    Vector3d low = Vector3d::Constant(-1 - 0x1p-40), high = Vector3d::Constant(1 + 0x1p-40);
    (open % 2 == 0 ? high : low)[open / 2] *= kInfinity;
    EXPECT_EQ(vector(region.low), low) << open;
    EXPECT_EQ(vector(region.high), high) << open;
  }
}

}  // namespace
}  // namespace pcl_bv::detail
