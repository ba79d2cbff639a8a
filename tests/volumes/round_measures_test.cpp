// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Known measures of Cylinder, Capsule, Ellipsoid and Hull, and what is special: flat, empty, refused.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "round_volumes.h"

namespace pcl_bv::detail {
namespace {

using Eigen::Vector3d;
using testing::cube;
using testing::Random;
using testing::volumes;

constexpr double kPi = 3.14159265358979323846;

TEST(RoundVolumes, RaysEnterAndLeaveWhereTheyShould) {
  const auto expect_interval = [](const AnyVolume& volume, const Vector3d& origin, const Vector3d& direction,
                                  double enter, double exit) {
    const auto hit = intersect(volume, origin, direction);
    ASSERT_TRUE(hit) << shape_name(volume);
    EXPECT_NEAR(hit->enter, enter, 1e-9) << shape_name(volume);
    EXPECT_NEAR(hit->exit, exit, 1e-9) << shape_name(volume);
  };
  const Cylinder cylinder({1, 0, 0}, {0, 0, 1}, 2, 3);
  expect_interval(cylinder, {-9, 0, 0}, {2, 0, 0}, 4, 6);
  expect_interval(cylinder, {1, 1, -5}, {0, 0, 1}, 2, 8);
  expect_interval(cylinder, {1, 0, 0}, {0, 3, 3}, 0, 2.0 / 3);
  EXPECT_FALSE(cylinder.intersect({1, 3, -5}, {0, 0, 1}));
  EXPECT_FALSE(cylinder.intersect({-9, 0, 3.1}, {1, 0, 0}));
  const Capsule capsule({0, 0, 0}, {0, 0, 4}, 1);
  expect_interval(capsule, {0, 0, -3}, {0, 0, 1}, 2, 8);
  expect_interval(capsule, {-3, 0, 2}, {1, 0, 0}, 2, 4);
  EXPECT_FALSE(capsule.intersect({-3, 0, 5.1}, {1, 0, 0}));
  expect_interval(Capsule({1, 2, 10}, {1, 2, 14}, 1), {1, 2, 7}, {0, 0, 1}, 2, 8);
  expect_interval(Capsule({1, 2, -2}, {1, 2, 2}, 1), {-2, 2, 0}, {1, 0, 0}, 2, 4);
  const Ellipsoid ellipsoid({0, 0, 0}, Eigen::Matrix3d::Identity(), {1, 2, 3});
  expect_interval(ellipsoid, {-3, 0, 0}, {1, 0, 0}, 2, 4);
  expect_interval(ellipsoid, {0, 0, -4}, {0, 0, 2}, 0.5, 3.5);
  EXPECT_FALSE(ellipsoid.intersect({1.1, -4, 0}, {0, 1, 0}));
  expect_interval(cube({0, 0, 0}, 1), {-1, 0.5, 0.5}, {1, 0, 0}, 1, 2);
  EXPECT_FALSE(cube({0, 0, 0}, 1).intersect({-1, 1.5, 0.5}, {1, 0, 0}));
}

TEST(RoundVolumes, HaveTheirKnownMeasures) {
  const Cylinder cylinder({0, 0, 0}, {0, 0, 2}, 2, 3);
  EXPECT_EQ(cylinder.axis(), Vector3d(0, 0, 1));
  EXPECT_DOUBLE_EQ(cylinder.volume(), 24 * kPi);
  EXPECT_DOUBLE_EQ(cylinder.surface_area(), 32 * kPi);
  EXPECT_DOUBLE_EQ(cylinder.distance({5, 0, 7}), 5);
  EXPECT_EQ(cylinder.support({3, 0, -1}), Vector3d(2, 0, -3));
  const Capsule capsule({0, 0, 0}, {0, 3, 0}, 2);
  EXPECT_DOUBLE_EQ(capsule.volume(), 12 * kPi + 32 * kPi / 3);
  EXPECT_DOUBLE_EQ(capsule.surface_area(), 28 * kPi);
  EXPECT_DOUBLE_EQ(capsule.distance({3, 7, 0}), 3);
  EXPECT_EQ(capsule.support({0, 5, 0}), Vector3d(0, 5, 0));
  const Ellipsoid ellipsoid({0, 0, 0}, Eigen::Matrix3d::Identity(), {1, 2, 3});
  EXPECT_DOUBLE_EQ(ellipsoid.volume(), 8 * kPi);
  EXPECT_NEAR(ellipsoid.surface_area(), 48.8821463026, 1e-8);
  EXPECT_DOUBLE_EQ(ellipsoid.distance({0, 0, 5}), 2);
  EXPECT_EQ(ellipsoid.support({0, -1, 0}), Vector3d(0, -2, 0));
  EXPECT_NEAR(Ellipsoid({0, 0, 0}, Eigen::Matrix3d::Identity(), {2, 2, 2}).surface_area(), 16 * kPi, 1e-12);
  EXPECT_NEAR(Ellipsoid({0, 0, 0}, Eigen::Matrix3d::Identity(), {0, 2, 2}).surface_area(), 8 * kPi, 1e-12);
  EXPECT_NEAR(Ellipsoid({0, 0, 0}, Eigen::Matrix3d::Identity(), {1e-7, 2, 2}).surface_area(), 8 * kPi, 1e-8);
  const Hull hull = cube({1, 2, 3}, 2);
  EXPECT_DOUBLE_EQ(hull.volume(), 8);
  EXPECT_DOUBLE_EQ(hull.surface_area(), 24);
  EXPECT_TRUE(hull.center().isApprox(Vector3d(2, 3, 4)));
  EXPECT_DOUBLE_EQ(hull.distance({4, 3, 4}), 1);
  EXPECT_DOUBLE_EQ(hull.distance({6, 8, 4}), 5);
  EXPECT_EQ(hull.support({1, -1, 2}), Vector3d(3, 2, 5));
}

TEST(RoundVolumes, DistancesAreMeasuredFromWhereTheVolumeIs) {
  EXPECT_DOUBLE_EQ(Cylinder({10, 20, 30}, {0, 0, 1}, 2, 3).distance({15, 20, 37}), 5);
  EXPECT_DOUBLE_EQ(Capsule({10, 20, 30}, {10, 23, 30}, 2).distance({13, 27, 30}), 3);
  EXPECT_DOUBLE_EQ(Ellipsoid({10, 20, 30}, Eigen::Matrix3d::Identity(), {1, 2, 3}).distance({10, 20, 35}), 2);
}

TEST(RoundVolumes, AHullOfAnySizeIsMeasuredAsOneOfSizeOne) {
  // Products of lengths must neither vanish nor overflow.
  for (const double unit : {0x1p-300, 0x1p-100, 0x1p100, 0x1p300}) {
    SCOPED_TRACE(unit);
    const Hull hull = cube(unit * Vector3d(1, 2, 3), 2 * unit);
    EXPECT_DOUBLE_EQ(hull.volume() / unit / unit / unit, 8);
    EXPECT_DOUBLE_EQ(hull.surface_area() / unit / unit, 24);
    EXPECT_TRUE((hull.center() / unit).isApprox(Vector3d(2, 3, 4)));
    EXPECT_DOUBLE_EQ(hull.distance(unit * Vector3d(6, 8, 4)) / unit, 5);
  }
}

TEST(RoundVolumes, AnAxisIsMadeAUnitOnceAndThenStays) {
  for (int k = 0; k < 3; ++k) {
    for (const double length : {1e-300, 0.5, 2.0, 1e100})
      EXPECT_EQ(Cylinder({0, 0, 0}, length * Vector3d::Unit(k), 1, 1).axis(), Vector3d::Unit(k)) << length;
  }
  Random random(9);
  for (int i = 0; i < 200; ++i) {
    const Vector3d axis = Cylinder({0, 0, 0}, random.vector(1), 1, 1).axis();
    EXPECT_NEAR(axis.norm(), 1, 1e-15);
    EXPECT_EQ(Cylinder({0, 0, 0}, axis, 1, 1).axis(), axis) << "seed 9, " << i;
  }
}

TEST(RoundVolumes, AnEllipsoidOfRevolutionHasTheSurfaceOfItsFormula) {
  const auto surface = [](double equator, double pole) {
    const double q = equator * equator, p = pole * pole;
    const double e = std::sqrt(pole < equator ? 1 - p / q : 1 - q / p);
    if (pole < equator) return 2 * kPi * q * (1 + (1 - e * e) / e * std::atanh(e));
    return 2 * kPi * q * (1 + pole / (equator * e) * std::asin(e));
  };
  for (double pole = 0.01; pole < 100; pole *= 1.03) {
    if (std::abs(pole - 1) < 0.1) continue;  // where the formula cancels
    const Ellipsoid ellipsoid({0, 0, 0}, Eigen::Matrix3d::Identity(), {1, pole, 1});
    EXPECT_NEAR(ellipsoid.surface_area() / surface(1, pole), 1, 1e-13) << pole;
  }
}

TEST(RoundVolumes, PlanesOfAMovedHullTouchItsFacesAtRightAngles) {
  Random random(8);
  for (int i = 0; i < 20; ++i) {
    const Hull hull = cube({1, 2, 3}, 2);
    const Eigen::Isometry3d transform = random.isometry(5);
    const Hull moved = hull.transformed(transform);
    ASSERT_EQ(moved.planes().size(), hull.planes().size());
    for (std::size_t k = 0; k < hull.planes().size(); ++k) {
      const HullPlane& plane = moved.planes()[k];
      EXPECT_LE((plane.normal - transform.linear() * hull.planes()[k].normal).norm(), 1e-15);
      double reach = -1e9;
      for (const Vector3d& v : moved.vertices())
        reach = std::max(reach, plane.normal.dot(v));
      EXPECT_NEAR(plane.offset, reach, 1e-13);
    }
  }
}

TEST(RoundVolumes, StoreNoNegativeZero) {
  const Vector3d zero(-0.0, -0.0, -0.0), up(-0.0, -0.0, 1);
  const Capsule capsule(zero, zero, -0.0);
  const Cylinder cylinder(zero, up, -0.0, -0.0);
  const Ellipsoid ellipsoid(zero, Eigen::Matrix3d::Identity(), zero);
  const Hull hull({zero}, {}, {{Vector3d(-0.0, -0.0, 1), -0.0}}, 0);
  for (int k = 0; k < 3; ++k) {
    for (const double stored :
         {capsule.a()[k], capsule.b()[k], cylinder.center()[k], cylinder.axis()[k], ellipsoid.center()[k],
          ellipsoid.radii()[k], hull.vertices()[0][k], hull.planes()[0].normal[k]})
      EXPECT_FALSE(std::signbit(stored)) << k;
  }
  for (const double stored :
       {capsule.radius(), cylinder.radius(), cylinder.half_height(), hull.planes()[0].offset})
    EXPECT_FALSE(std::signbit(stored));
}

TEST(RoundVolumes, NearestPointOfAnEllipsoidIsOnIt) {
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    const Ellipsoid ellipsoid(random.vector(3), random.isometry(1).linear(), {3, 1, 0.01});
    const Vector3d normal = random.vector(1).normalized();
    const Vector3d rim = ellipsoid.support(normal);
    EXPECT_NEAR(ellipsoid.distance(rim + 0.75 * normal), 0.75, 1e-9);
  }
}

TEST(RoundVolumes, AFlatHullIsMeasuredByItsPolygon) {
  const std::vector<Vector3d> square = {{0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1}};
  std::vector<HullPlane> planes = {{{0, 0, 1}, 1},  {{0, 0, -1}, -1}, {{1, 0, 0}, 2},
                                   {{-1, 0, 0}, 0}, {{0, 1, 0}, 2},   {{0, -1, 0}, 0}};
  const Hull flat(square, {}, planes, 2);
  EXPECT_EQ(flat.volume(), 0);
  EXPECT_DOUBLE_EQ(flat.surface_area(), 8);
  EXPECT_TRUE(flat.center().isApprox(Vector3d(1, 1, 1)));
  EXPECT_DOUBLE_EQ(flat.distance({1, 1, 3}), 2);
  EXPECT_DOUBLE_EQ(flat.distance({5, 1, 5}), 5);
  EXPECT_EQ(flat.mesh().faces.size(), 2u);
  const Hull line({{0, 0, 1}, {2, 0, 1}}, {}, planes, 1);
  EXPECT_TRUE(line.center().isApprox(Vector3d(1, 0, 1)));
  EXPECT_DOUBLE_EQ(line.distance({1, 5, 1}), 5);
}

TEST(RoundVolumes, EmptyOnesAreEmpty) {
  for (const AnyVolume& volume :
       {AnyVolume(Cylinder()), AnyVolume(Capsule()), AnyVolume(Ellipsoid()), AnyVolume(Hull()),
        AnyVolume(Prism()), AnyVolume(Cylinder({0, 0, 0}, {0, 0, 1}, -1, 1)),
        AnyVolume(Capsule({0, 0, 0}, {0, 0, 1}, -1)),
        AnyVolume(Ellipsoid({0, 0, 0}, Eigen::Matrix3d::Identity(), {1, -1, 1}))}) {
    SCOPED_TRACE(shape_name(volume));
    EXPECT_TRUE(empty(volume));
    EXPECT_FALSE(contains(volume, {0, 0, 0}));
    EXPECT_EQ(pcl_bv::volume(volume), 0);
    EXPECT_EQ(surface_area(volume), 0);
    EXPECT_TRUE(center(volume).hasNaN());
    EXPECT_TRUE(support(volume, {1, 0, 0}).hasNaN());
    EXPECT_EQ(distance(volume, {0, 0, 0}), std::numeric_limits<double>::infinity());
    EXPECT_FALSE(intersect(volume, {0, 0, 0}, {1, 0, 0}));
    EXPECT_TRUE(aabb(volume).empty());
    EXPECT_TRUE(mesh(volume).vertices.empty());
    EXPECT_TRUE(empty(transformed(volume, Eigen::Isometry3d::Identity())));
  }
}

TEST(RoundVolumes, AxesOfAnEllipsoidMayBeOffByWhatIsSaidAndNoMore) {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  axes(0, 1) = 1e-12;  // axis 0 . axis 1, without rounding
  EXPECT_NO_THROW(Ellipsoid({0, 0, 0}, axes, {1, 1, 1}));
  axes(0, 1) = std::nextafter(1e-12, 1);
  EXPECT_THROW(Ellipsoid({0, 0, 0}, axes, {1, 1, 1}), std::invalid_argument);
}

TEST(RoundVolumes, BadNumbersAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
  EXPECT_THROW(Cylinder({nan, 0, 0}, {0, 0, 1}, 1, 1), std::invalid_argument);
  EXPECT_THROW(Cylinder({0, 0, 0}, {0, 0, 0}, 1, 1), std::invalid_argument);
  EXPECT_THROW(Capsule({0, 0, 0}, {0, 0, 1}, nan), std::invalid_argument);
  EXPECT_THROW(Ellipsoid({0, 0, 0}, 2 * one, {1, 1, 1}), std::invalid_argument);
  EXPECT_THROW(Ellipsoid({0, 0, 0}, one, {1, nan, 1}), std::invalid_argument);
  EXPECT_THROW(Hull({{0, 0, 0}}, {}, {}, 0), std::invalid_argument);
  EXPECT_THROW(Hull({{0, 0, 0}}, {{0, 0, 1}}, {{{1, 0, 0}, 0}}, 3), std::invalid_argument);
  EXPECT_THROW(Hull({{0, 0, 0}}, {}, {{{1, 0, 0}, 0}}, 4), std::invalid_argument);
}

TEST(RoundVolumes, PointsThatAreNanAreNowhere) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Random random(1);
  for (const AnyVolume& volume : volumes(random, {"unit", 0, 1})) {
    EXPECT_FALSE(contains(volume, {nan, 0, 0})) << shape_name(volume);
    EXPECT_TRUE(std::isnan(distance(volume, {0, nan, 0}))) << shape_name(volume);
  }
}

TEST(RoundVolumes, MeshesAreClosedOutwardAndNearlyAsLarge) {
  Random random(1);
  for (const AnyVolume& any : volumes(random, {"unit", 0, 1})) {
    const Mesh surface = mesh(any);
    double six = 0;
    for (const auto& face : surface.faces) {
      const Vector3d a = surface.vertices[static_cast<std::size_t>(face[0])] - center(any);
      for (std::size_t i = 1; i + 1 < face.size(); ++i) {
        six += a.dot((surface.vertices[static_cast<std::size_t>(face[i])] - center(any))
                         .cross(surface.vertices[static_cast<std::size_t>(face[i + 1])] - center(any)));
      }
    }
    EXPECT_GT(six / 6, 0.9 * volume(any)) << shape_name(any);
    EXPECT_LT(six / 6, volume(any) * (1 + 1e-12)) << shape_name(any);
  }
}

}  // namespace
}  // namespace pcl_bv::detail
