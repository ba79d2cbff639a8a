// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A point with a coordinate that is not finite is in no volume and infinitely far from each, unless it has a
// NaN.

#include <gtest/gtest.h>

#include <cmath>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/volumes/any_volume.h"
#include "pcl_bv/volumes/hull.h"

namespace pcl_bv::detail {
namespace {

using Eigen::Vector3d;

std::vector<AnyVolume> one_of_each_kind() {
  const Eigen::Matrix3d turned = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  Kdop kdop(KdopSet::dop26());
  for (const Vector3d& p : {Vector3d(1, 2, 3), Vector3d(-1, 0, 1), Vector3d(2, -2, 0)})
    kdop.extend(p);
  return {Aabb({-1, -1, -1}, {1, 1, 1}),
          kdop,
          Sphere({0, 0, 0}, 1),
          Sphere({0, 0, 0}, 1e200),
          Obb({0, 0, 0}, Eigen::Matrix3d::Identity(), {1, 1, 1}),
          Obb({1, 0, 0}, turned, {1, 2, 3}),
          Cylinder({0, 0, 0}, {0, 0, 1}, 1, 1),
          Cylinder({0, 0, 0}, {1, 2, 3}, 1, 1),
          Capsule({0, 0, 0}, {0, 0, 1}, 1),
          Capsule({0, 0, 0}, {1, 2, 3}, 1),
          Ellipsoid({0, 0, 0}, Eigen::Matrix3d::Identity(), {1, 2, 3}),
          Ellipsoid({0, 0, 0}, turned, {1, 2, 3}),
          frustum(Eigen::Isometry3d::Identity(), 1, 10, 1, 1),
          Hull({{0, 0, 0}}, {}, {{{1, 1, 1}, 1}, {{1, 0, 0}, 1}}, 3),
          Prism(Eigen::Matrix3d::Identity(), {{-1, -1}, {1, -1}, {0, 2}}, -1, 1),
          Prism(Eigen::Matrix3d::Identity(), {{-1, -1}, {1, 1}}, -1, 1),
          Prism(orthonormal_axes(turned), {{-1, -1}, {1, -1}, {0, 2}}, -1, 1)};
}

std::vector<Vector3d> points_not_finite() {
  std::vector<Vector3d> points;
  const double values[] = {0, kInfinity, -kInfinity, kNan};
  for (int i = 1; i < 64; ++i)
    points.emplace_back(values[i % 4], values[i / 4 % 4], values[i / 16]);
  return points;
}

TEST(PointNotFinite, IsInNoVolume) {
  for (const AnyVolume& volume : one_of_each_kind()) {
    for (const Vector3d& p : points_not_finite())
      EXPECT_FALSE(contains(volume, p)) << shape_name(volume) << ", " << p.transpose();
  }
}

TEST(PointNotFinite, IsInfinitelyFarFromEachVolumeUnlessItHasANan) {
  for (const AnyVolume& volume : one_of_each_kind()) {
    for (const Vector3d& p : points_not_finite()) {
      const double found = distance(volume, p);
      EXPECT_TRUE(p.hasNaN() ? std::isnan(found) : found == kInfinity)
          << shape_name(volume) << ", " << p.transpose() << ": " << found;
    }
  }
}

TEST(PointNotFinite, IsWhereNoRayBeginsOrLeads) {
  for (const AnyVolume& volume : one_of_each_kind()) {
    for (const Vector3d& p : points_not_finite()) {
      EXPECT_FALSE(intersect(volume, p, Vector3d(1, 1, 1)))
          << shape_name(volume) << ", from " << p.transpose();
      EXPECT_FALSE(intersect(volume, Vector3d(0.1, 0.1, 0.1), p))
          << shape_name(volume) << ", to " << p.transpose();
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail
