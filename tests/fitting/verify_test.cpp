// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/fitting/fit.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "clouds.h"
#include "exact.h"
#include "executions.h"

namespace pcl_bv::detail {
namespace {

TEST(Verify, CountsPointsThatAreOneDoubleOutside) {
  const double p[] = {1, 2, 3, 0.5, 2, 3};
  const PointView points = PointView::of(p, 24, 2);
  const Aabb tight({0.5, 2, 3}, {1, 2, 3});
  EXPECT_EQ(verify(tight, points).outside, 0U);
  const Verification result = verify(Aabb({0.5, 2, 3}, {std::nextafter(1.0, 0.0), 2, 3}), points);
  EXPECT_EQ(result.checked, 2U);
  EXPECT_EQ(result.outside, 1U);
  EXPECT_EQ(result.max_violation, 0x1p-53);
}

TEST(Verify, DecidesBoxesThatRoundingCannotTell) {
  const Obb box(Aabb({-1, -1, -1}, {1, 1, 1}));
  for (const double sign : {-1.0, 1.0}) {
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d on = sign * Eigen::Vector3d::Unit(axis), beyond = (1 + 0x1p-52) * on;
      EXPECT_EQ(verify(box, PointView::of(on.data(), 24, 1)).outside, 0U) << on.transpose();
      EXPECT_EQ(verify(box, PointView::of(beyond.data(), 24, 1)).outside, 1U) << on.transpose();
    }
  }
}

TEST(Verify, DecidesSlabsThatRoundingCannotTell) {
  // x + y - z is exactly 1, which double arithmetic computes as 0.
  const double p[] = {1e20, 1, 1e20};
  const PointView points = PointView::of(p, 24, 1);
  Kdop kdop(KdopSet::dop14());
  kdop.extend({1e20, 1, 1e20});
  EXPECT_EQ(kdop.max(4), 1.0);
  EXPECT_EQ(verify(kdop, points).outside, 0U);
  SlabVector min(7), max(7);
  for (Eigen::Index k = 0; k < 7; ++k) {
    min[k] = kdop.min(static_cast<std::size_t>(k));
    max[k] = kdop.max(static_cast<std::size_t>(k));
  }
  max[4] = std::nextafter(1.0, 0.0);
  min[4] = 0;
  EXPECT_EQ(verify(Kdop(KdopSet::dop14(), min, max), points).outside, 1U);
}

TEST(Verify, DecidesSpheresThatRoundingCannotTell) {
  const double p[] = {3, 4, 0, 0, 0, 5};
  const PointView points = PointView::of(p, 24, 2);
  EXPECT_EQ(verify(Sphere({0, 0, 0}, 5), points).outside, 0U) << "both points are exactly on it";
  EXPECT_EQ(verify(Sphere({0, 0, 0}, std::nextafter(5.0, 0.0)), points).outside, 2U);
  EXPECT_EQ(verify(Sphere({0x1p-80, 0, 0}, 5), points).outside, 1U)
      << "only the second has x = 0 and moves outward";
}

TEST(Verify, DecidesCylindersByTheAxisAsStored) {
  // Never exactly of length 1: for one point half height and radius are the least doubles that hold it.
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto vector = [&] { return Eigen::Vector3d(unit(random), unit(random), unit(random)); };
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d center = vector(), point = vector(), up = vector();
    const Eigen::Vector3d axis = Cylinder(center, up, 1, 1).axis();
    const test::ExactAlong q(center, axis, {point.x(), point.y(), point.z()});
    const test::Rational along = q.along * q.along / q.squared_axis, across = q.squared - along;
    const double half = test::least_root_above(along, std::sqrt(static_cast<double>(along)));
    const double radius = test::least_root_above(across, std::sqrt(static_cast<double>(across)));
    const PointView points = PointView::of(point.data(), 24, 1);
    const auto outside = [&](double r, double h) {
      return verify(Cylinder(center, up, r, h), points).outside;
    };
    ASSERT_EQ(outside(radius, half), 0U) << "seed 8, " << i;
    ASSERT_EQ(outside(radius, std::nextafter(half, 0)), 1U) << "seed 8, " << i;
    ASSERT_EQ(outside(std::nextafter(radius, 0), half), 1U) << "seed 8, " << i;
  }
}

TEST(Verify, DecidesPlanesThatRoundingCannotTell) {
  constexpr double odd = 1 + 0x1p-52;  // squared it is more than the double nearest to that
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d point = 0x1p20 * odd * Eigen::Vector3d::Unit(axis);
    const Eigen::Vector3d normal = odd * Eigen::Vector3d::Unit(axis);
    const double offset = 0x1p20 * (odd * odd);
    const PointView points = PointView::of(point.data(), 24, 1);
    EXPECT_EQ(verify(Hull({point}, {}, {{normal, offset}}, 0), points).outside, 1U) << axis;
    EXPECT_EQ(verify(Hull({point}, {}, {{normal, offset * odd}}, 0), points).outside, 0U) << axis;
    std::vector<Eigen::Vector3d> directions = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    directions[static_cast<std::size_t>(axis)] = normal;
    const auto set = std::make_shared<const KdopSet>(directions);
    SlabVector low = SlabVector::Zero(3), high = SlabVector::Zero(3);
    high[axis] = offset;
    EXPECT_EQ(verify(Kdop(set, low, high), points).outside, 1U) << axis;
    high[axis] *= odd;
    EXPECT_EQ(verify(Kdop(set, low, high), points).outside, 0U) << axis;
  }
}

TEST(Verify, SaysHowFarOutsideThePointsAre) {
  const auto worst = [](const AnyVolume& volume, const Eigen::Vector3d& point) {
    return verify(volume, PointView::of(point.data(), 24, 1)).max_violation;
  };
  const Capsule capsule({0, 0, 0}, {0, 0, 4}, 1);
  EXPECT_DOUBLE_EQ(worst(capsule, {3, 0, 0.5}), 2);
  EXPECT_DOUBLE_EQ(worst(capsule, {0, 3, -4}), 4);
  EXPECT_DOUBLE_EQ(worst(capsule, {3, 0, 8}), 4);
  EXPECT_DOUBLE_EQ(worst(Capsule({1, 0, 0}, {1, 0, 0}, 1), {1, 5, 0}), 4);
  const Cylinder cylinder({0, 0, 1}, {0, 0, 1}, 1, 2);
  EXPECT_DOUBLE_EQ(worst(cylinder, {3, 0, 1}), 2);
  EXPECT_DOUBLE_EQ(worst(cylinder, {0, 0.5, -4}), 3);
  const Ellipsoid ellipsoid({1, 0, 0}, Eigen::Matrix3d::Identity(), {1, 2, 3});
  EXPECT_DOUBLE_EQ(worst(ellipsoid, {5, 0, 0}), 3);
  EXPECT_DOUBLE_EQ(worst(ellipsoid, {1, 2.25, 0}), 0.25);
  EXPECT_EQ(worst(ellipsoid, {1, 0, 2.75}), 0);
  EXPECT_DOUBLE_EQ(worst(Sphere({1, 0, 0}, 2), {1, 0, 5}), 3);
}

// A box from 0 to (x, y, z) as each volume with flat sides. The last one has a bay.
std::vector<AnyVolume> boxes(double x, double y, double z) {
  const Aabb box({0, 0, 0}, {x, y, z});
  std::vector<HullPlane> planes;
  for (int axis = 0; axis < 3; ++axis) {
    planes.push_back({Eigen::Vector3d::Unit(axis), box.max()[axis]});
    planes.push_back({-Eigen::Vector3d::Unit(axis), -box.min()[axis]});
  }
  const auto corners = box.corners();
  const Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  Kdop slabs(KdopSet::dop6());
  for (const Eigen::Vector3d& corner : corners)
    slabs.extend(corner);
  return {
      box,
      Obb(box),
      slabs,
      Hull({corners.begin(), corners.end()}, {}, planes, 3),
      Prism(axes, {{0, 0}, {x, 0}, {x, y}, {0, y}}, 0, z),
      Prism(axes, {{0, 0}, {x, 0}, {x, y}, {3 * x / 4, y}, {5 * x / 8, y / 2}, {x / 2, y}, {0, y}}, 0, z)};
}

TEST(Verify, SaysHowFarBeyondASideThePointsAre) {
  const Eigen::Vector3d size(1, 2, 3);
  for (const AnyVolume& volume : boxes(size.x(), size.y(), size.z())) {
    const auto worst = [&](const Eigen::Vector3d& point) {
      return verify(volume, PointView::of(point.data(), 24, 1)).max_violation;
    };
    const Eigen::Vector3d inside(0.25, 0.25, 1.5);
    EXPECT_EQ(worst(inside), 0) << shape_name(volume);
    for (int axis = 0; axis < 3; ++axis) {
      Eigen::Vector3d below = inside, above = inside;
      below[axis] = -4;
      above[axis] = size[axis] + 2;
      EXPECT_DOUBLE_EQ(worst(below), 4) << shape_name(volume) << ", axis " << axis;
      EXPECT_DOUBLE_EQ(worst(above), 2) << shape_name(volume) << ", axis " << axis;
    }
  }
}

TEST(Verify, APointOnAnySideOfABoxIsOutside) {
  const Aabb box({-1, -1, -1}, {1, 1, 1});
  for (int side = 0; side < 27; ++side) {
    const Eigen::Vector3d point(2 * (side % 3 - 1), 2 * (side / 3 % 3 - 1), 2 * (side / 9 - 1));
    const PointView points = PointView::of(point.data(), 24, 1);
    EXPECT_EQ(verify(box, points).outside, point.isZero() ? 0U : 1U) << point.transpose();
    EXPECT_EQ(verify(Obb(box), points).outside, point.isZero() ? 0U : 1U) << point.transpose();
  }
}

TEST(Verify, EverythingIsOutsideAnEmptyVolume) {
  const float p[] = {1, 2, 3};
  EXPECT_EQ(verify(Aabb(), PointView::of(p, 12, 1)).outside, 1U);
  EXPECT_EQ(verify(Sphere(), PointView::of(p, 12, 1)).outside, 1U);
  EXPECT_EQ(verify(Kdop(), PointView::of(p, 12, 1)).outside, 1U);
}

TEST(Verify, IgnoresPointsThatAreNotFinite) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float p[] = {nan, 2, 3, 1, 1, 1};
  const Verification result = verify(Aabb({1, 1, 1}, {1, 1, 1}), PointView::of(p, 12, 2));
  EXPECT_EQ(result.checked, 1U);
  EXPECT_EQ(result.outside, 0U);
}

TEST(Verify, CountsTheSameOnEveryThread) {
  const test::TestCloud<float> cloud = test::gaussian<float>(20'000, 5);
  const Verification expected = verify(Sphere({0, 0, 0}, 2), cloud.view());
  EXPECT_GT(expected.outside, 1000U);
  for (const auto& [name, execution] : test::every_execution()) {
    const Verification result = verify(Sphere({0, 0, 0}, 2), cloud.view(), execution);
    EXPECT_EQ(result.outside, expected.outside) << name;
    EXPECT_EQ(result.max_violation, expected.max_violation) << name;
  }
}

}  // namespace
}  // namespace pcl_bv::detail
