// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Claims of the ray test: one contract for all shapes. Enclosure is judged in ray_exact_test.cpp.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "exact.h"
#include "pcl_bv/volumes/any_volume.h"

namespace pcl_bv::detail {
namespace {

using namespace pcl_bv::testing;
using Eigen::Vector3d;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Of half extent or radius 1 around the centre.
std::vector<AnyVolume> shapes(const Vector3d& center = Vector3d::Zero()) {
  const Aabb box(center - Vector3d::Ones(), center + Vector3d::Ones());
  return {box, Kdop(KdopSet::dop6(), box.min(), box.max()), Sphere(center, 1)};
}

TEST(Ray, IntervalIsThatComputedByHandForEveryShape) {
  for (const AnyVolume& v : shapes({5, 0, 0})) {
    SCOPED_TRACE(shape_name(v));
    const auto through = intersect(v, {0, 0, 0}, {2, 0, 0});
    ASSERT_TRUE(through);
    EXPECT_NEAR(through->enter, 2, 1e-13);
    EXPECT_NEAR(through->exit, 3, 1e-13);
    const auto from_inside = intersect(v, {5, 0.5, 0}, {0, 1, 0});
    ASSERT_TRUE(from_inside);
    EXPECT_EQ(from_inside->enter, 0);
    EXPECT_NEAR(from_inside->exit, 0.5, 1e-13);
    EXPECT_FALSE(intersect(v, {0, 0, 0}, {-2, 0, 0})) << "behind";
    EXPECT_FALSE(intersect(v, {0, 1 + 1e-9, 0}, {1, 0, 0})) << "beside";
    EXPECT_FALSE(intersect(v, {0, 0, 0}, {0, 1, 0}));
  }
}

TEST(Ray, ParameterIsInUnitsOfADirectionOfAnyLength) {
  for (const AnyVolume& v : shapes({5, 0.1, -0.2})) {
    SCOPED_TRACE(shape_name(v));
    const auto unit = intersect(v, {0, 0, 0}, {1, 0, 0});
    for (const double length : {1e-280, 1e-160, 1e-30, 3.0, 1e30, 1e160, 1e280}) {
      const auto scaled = intersect(v, {0, 0, 0}, {length, 0, 0});
      ASSERT_TRUE(scaled);
      EXPECT_NEAR(scaled->enter * length, unit->enter, 1e-13) << length;
      EXPECT_NEAR(scaled->exit * length, unit->exit, 1e-13) << length;
      EXPECT_FALSE(intersect(v, {0, 0, 0}, {-length, 0, 0}));
    }
    const auto tiny = intersect(v, {0, 0, 0}, {1e-320, 0, 0});
    ASSERT_TRUE(tiny) << "beyond the range of double, and still no miss";
    EXPECT_LE(tiny->enter, std::numeric_limits<double>::max());
    EXPECT_EQ(tiny->exit, infinity);
  }
}

TEST(Ray, AZeroDirectionTestsThePoint) {
  for (const AnyVolume& v : shapes()) {
    SCOPED_TRACE(shape_name(v));
    for (const Vector3d& p :
         {Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(1.001, 0, 0), Vector3d(9, 9, 9)}) {
      const auto hit = intersect(v, p, {0, -0.0, 0});
      EXPECT_EQ(hit.has_value(), contains(v, p));
      if (!hit) continue;
      EXPECT_EQ(hit->enter, 0);
      EXPECT_EQ(hit->exit, infinity);
    }
  }
}

TEST(Ray, MissesTheEmptyVolume) {
  for (const AnyVolume& v : {AnyVolume(Aabb()), AnyVolume(Kdop()), AnyVolume(Sphere())}) {
    EXPECT_FALSE(intersect(v, {0, 0, 0}, {1, 0, 0}));
    EXPECT_FALSE(intersect(v, {0, 0, 0}, {1e-320, 0, 0}));
    EXPECT_FALSE(intersect(v, {0, 0, 0}, {0, 0, 0}));
  }
}

TEST(Ray, OfNumbersThatAreNotFiniteIsAMiss) {
  for (const AnyVolume& v : shapes()) {
    for (int k = 0; k < 3; ++k) {
      for (const double bad : {nan, infinity, -infinity}) {
        Vector3d p(0.1, 0.2, 0.3);
        p[k] = bad;
        EXPECT_FALSE(intersect(v, p, {1, 2, 3}));
        EXPECT_FALSE(intersect(v, {0, 0, 0}, p));
        EXPECT_FALSE(intersect(v, p, {0, 0, 0}));
      }
    }
  }
}

TEST(Ray, FromAContainedPointEntersAtZero) {
  Random random(57);
  for (const Scale& scale : scales()) {
    SCOPED_TRACE(scale.name);
    for (int i = 0; i < 100; ++i) {
      const Vector3d p = random.point(scale), q = random.point(scale), d = random.vector(scale.extent);
      // p is on the surface of all three, or within what contains() allows for.
      const double radius = (p - q).stableNorm() * (1 - 0x1p-52);
      for (const AnyVolume& v : {AnyVolume(Aabb().extend(p).extend(q)), AnyVolume(Kdop().extend(p)),
                                 AnyVolume(Sphere(q, radius)), AnyVolume(Sphere(p, 0))}) {
        if (!contains(v, p)) continue;
        for (const Vector3d& direction : {d, Vector3d(-d), Vector3d(p - q), Vector3d(q - p)}) {
          const auto hit = intersect(v, p, direction);
          ASSERT_TRUE(hit);
          ASSERT_EQ(hit->enter, 0);
        }
      }
    }
  }
  const double tiny = std::sqrt(std::numeric_limits<double>::min());
  const Vector3d near(0.9 * tiny, 0, 0);
  const Sphere point({0, 0, 0}, 0);
  ASSERT_TRUE(point.contains(near)) << "the square underflows";
  const auto hit = point.intersect(near, {1, 1, 0});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->enter, 0);
}

TEST(Ray, FromAPointThatATinyEllipsoidContainsIsAHit) {
  // Of radii near the smallest normal number; contains() allows for as much in each coordinate.
  const double least = std::numeric_limits<double>::min();
  const Ellipsoid tiny({0, 0, 0}, Eigen::Matrix3d::Identity(), Vector3d::Constant(0.9 * least));
  const Vector3d point = least * Vector3d(1.8, 1, 1);
  ASSERT_TRUE(tiny.contains(point));
  for (const Vector3d& direction : {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(1, 1, 1)}) {
    const auto hit = tiny.intersect(point, direction);
    ASSERT_TRUE(hit) << direction.transpose();
    EXPECT_EQ(hit->enter, 0);
  }
}

TEST(Ray, ThroughAFlatEllipsoidHitsItUpToItsEdgeOnly) {
  for (const double thickness : {0.0, 1e-12, 1e-7, 1e-3}) {
    const Ellipsoid disc(Vector3d(1, 2, 3), Eigen::Matrix3d::Identity(), Vector3d(2, 1, thickness));
    for (const double share : {0.0, 0.5, 0.999999}) {
      EXPECT_TRUE(disc.intersect({1 + 2 * share, 2, 8}, {0, 0, -1})) << thickness << " " << share;
      EXPECT_TRUE(disc.intersect({1, 2 - share, -8}, {0, 0, 1})) << thickness << " " << share;
    }
    for (const double share : {1.000001, 1.5, 1.999, 3.0}) {
      EXPECT_FALSE(disc.intersect({1 + 2 * share, 2, 8}, {0, 0, -1})) << thickness << " " << share;
      EXPECT_FALSE(disc.intersect({1, 2 - share, -8}, {0, 0, 1})) << thickness << " " << share;
    }
  }
}

TEST(Ray, InTheFaceOfAFlatKdopRunsTheWholeWay) {
  const Kdop triangle = Kdop(KdopSet::dop14()).extend({1, 0, 0}).extend({0, 1, 0}).extend({0, 0, 1});
  const auto edge = triangle.intersect({2, -1, 0}, {-1, 1, 0});
  ASSERT_TRUE(edge);
  EXPECT_NEAR(edge->enter, 1, 1e-14);
  EXPECT_NEAR(edge->exit, 2, 1e-14);
  const auto across = triangle.intersect({0, 0, 0}, {1, 1, 1});
  ASSERT_TRUE(across);
  EXPECT_NEAR(across->enter, 1.0 / 3, 1e-14);
  EXPECT_NEAR(across->exit, 1.0 / 3, 1e-14);
  EXPECT_FALSE(triangle.intersect({2, -1, 1e-9}, {-1, 1, 0})) << "beside the edge";

  const Kdop line = Kdop().extend({0, 0, 0}).extend({3, 3, 3});
  const auto along = line.intersect({-1, -1, -1}, {1, 1, 1});
  ASSERT_TRUE(along);
  EXPECT_NEAR(along->enter, 1, 1e-14);
  EXPECT_NEAR(along->exit, 4, 1e-14);
  EXPECT_FALSE(line.intersect({-1, -1, -1 + 1e-9}, {1, 1, 1}));
}

}  // namespace
}  // namespace pcl_bv::detail
