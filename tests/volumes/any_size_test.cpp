// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Measures of volumes whose squares or products of two sides leave the range of double.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "kdop_sets.h"
#include "pcl_bv/volumes/any_volume.h"
#include "round_volumes.h"

namespace pcl_bv::detail {
namespace {

using Eigen::Vector3d;

constexpr double kPi = 3.14159265358979323846;

std::vector<Vector3d> every_order(std::array<double, 3> sides) {
  std::sort(sides.begin(), sides.end());
  std::vector<Vector3d> orders;
  do {
    orders.emplace_back(sides[0], sides[1], sides[2]);
  } while (std::next_permutation(sides.begin(), sides.end()));
  return orders;
}

// A box from 0 to `size` with other slabs that just hold it.
Kdop kdop_of(const std::shared_ptr<const KdopSet>& set, const Vector3d& size) {
  Kdop kdop(set);
  for (int i = 0; i < 8; ++i)
    kdop.extend(size.cwiseProduct(Vector3d(i & 1, i >> 1 & 1, i >> 2)));
  return kdop;
}

TEST(AnySize, VolumesAreTheProductsOfSidesThoughTwoOfThemUnderflowOrOverflow) {
  const auto expect = [](const AnyVolume& any, double expected) {
    EXPECT_NEAR(volume(any) / expected, 1, 1e-12) << shape_name(any);
  };
  const Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  for (const std::array<double, 3> sides :
       {std::array{0x1p300, 0x1p-500, 0x1p-700}, std::array{0x1p300, 0x1p-600, 0x1p-600},
        std::array{0x1p600, 0x1p600, 0x1p-700}, std::array{0x1p800, 0x1p400, 0x1p-500}}) {
    for (const Vector3d& s : every_order(sides)) {
      SCOPED_TRACE(s.transpose());
      const double product = std::ldexp(1, std::ilogb(s.x()) + std::ilogb(s.y()) + std::ilogb(s.z()));
      expect(Aabb(Vector3d::Zero(), s), product);
      expect(Obb(Vector3d::Zero(), axes, s), 8 * product);
      expect(Ellipsoid(Vector3d::Zero(), axes, s), 4 * kPi / 3 * product);
      if (sides[0] < 0x1p400) {
        for (const auto& set : {KdopSet::dop6(), KdopSet::dop14(), KdopSet::dop26()})
          expect(kdop_of(set, s), product);
      }
    }
  }
  expect(Cylinder(Vector3d::Zero(), {0, 0, 1}, 0x1p-600, 0x1p300), 2 * kPi * 0x1p-900);
  expect(Cylinder(Vector3d::Zero(), {0, 0, 1}, 0x1p600, 0x1p-300), 2 * kPi * 0x1p900);
  expect(Capsule(Vector3d::Zero(), {0, 0, 0x1p300}, 0x1p-600), kPi * 0x1p-900);
}

TEST(AnySize, DistancesFromPolytopesScaleWithThem) {
  const Hull cube = testing::cube(Vector3d::Zero(), 1);
  for (const double unit : {0x1p-1000, 0x1p-700, 1.0, 0x1p300}) {
    for (const Vector3d& p : {Vector3d(0.5, 0.25, 3), Vector3d(-2, 0.5, 0.5), Vector3d(3, 4, 0.5)}) {
      SCOPED_TRACE(unit);
      const Kdop kdop = kdop_of(KdopSet::dop14(), Vector3d(1, 1, 1) * unit);
      EXPECT_EQ(kdop.distance(p * unit), kdop_of(KdopSet::dop14(), Vector3d(1, 1, 1)).distance(p) * unit);
    }
  }
  const double far = 1e100;
  EXPECT_NEAR(cube.distance({far, 0, 0}) / far, 1, 1e-12);
  Kdop tiny = kdop_of(KdopSet::dop14(), Vector3d(1e-300, 1e-300, 1e-300));
  EXPECT_NEAR(tiny.distance({0, far, 0}) / far, 1, 1e-12);
  std::vector<Vector3d> vertices = cube.vertices();
  std::vector<HullPlane> planes = cube.planes();
  for (Vector3d& v : vertices)
    v *= 0x1p-1000;
  for (HullPlane& plane : planes)
    plane.offset *= 0x1p-1000;
  EXPECT_NEAR(Hull(vertices, cube.triangles(), planes, 3).distance({0, 0, -far}) / far, 1, 1e-12);
  for (const double radius : {0.0, 0x1p-1074, 1e-300, 1e-60, 1e-40}) {
    const Ellipsoid ellipsoid(Vector3d::Zero(), Eigen::Matrix3d::Identity(), {radius, radius / 2, 0});
    EXPECT_NEAR(ellipsoid.distance({far, 0, -far}) / (std::sqrt(2) * far), 1, 1e-12) << radius;
  }
}

TEST(AnySize, AnAxisOfDenormalLengthIsMadeAUnit) {
  const double least = 0x1p-1074;
  const Cylinder cylinder(Vector3d::Zero(), {least, -least, 2 * least}, 1, 1);
  EXPECT_NEAR(cylinder.axis().norm(), 1, 1e-15);
  EXPECT_NEAR(cylinder.axis().dot(Vector3d(1, -1, 2)) / std::sqrt(6), 1, 1e-15);
  const Vector3d far = Sphere(Vector3d::Zero(), 1).support({least, least, least});
  EXPECT_NEAR(far.norm(), 1, 1e-15);
}

}  // namespace
}  // namespace pcl_bv::detail
