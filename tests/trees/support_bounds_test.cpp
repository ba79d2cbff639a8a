// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// How far volumes reach along the cube's directions: no less than they do, in rationals, and hardly more.
// Needles and plates at right angles to a direction show what rounding of their axes amounts to.

#include "support_bounds.h"

#include <gtest/gtest.h>

#include "any_volumes.h"
#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv {
namespace {

using namespace testing;

// The weights with which the axes sum up to n.
ExactPoint along_axes(const ExactPoint& n, const Eigen::Matrix3d& axes) {
  const ExactPoint a = exact(axes.col(0)), b = exact(axes.col(1)), c = exact(axes.col(2));
  const auto cross = [](const ExactPoint& u, const ExactPoint& v) {
    return ExactPoint{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  };
  const Rational det = product(a, cross(b, c));
  return {product(n, cross(b, c)) / det, product(n, cross(c, a)) / det, product(n, cross(a, b)) / det};
}

bool holds(const Rational& s, const ExactPoint& n, const Sphere& sphere) {
  const Rational r(sphere.radius());
  return s >= 0 && s * s >= r * r * product(n, n);
}

bool holds(const Rational& s, const ExactPoint& n, const Obb& box) {
  const ExactPoint weights = along_axes(n, box.axes());
  Rational reach = 0;
  for (std::size_t i = 0; i < 3; ++i)
    reach += abs(weights[i]) * Rational(box.half_extents()[static_cast<int>(i)]);
  return s >= reach;
}

bool holds(const Rational& s, const ExactPoint& n, const Ellipsoid& ellipsoid) {
  const ExactPoint weights = along_axes(n, ellipsoid.axes());
  Rational squares = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Rational part = weights[i] * Rational(ellipsoid.radii()[static_cast<int>(i)]);
    squares += part * part;
  }
  return s >= 0 && s * s >= squares;
}

// s >= a + b, of which the squares are known.
bool holds(const Rational& s, const ExactPoint& n, const Cylinder& cylinder) {
  const ExactPoint axis = exact(cylinder.axis());
  const Rational na = product(n, axis), aa = product(axis, axis), h(cylinder.half_height()),
                 r(cylinder.radius());
  const Rational along = na * na / aa * h * h, across = (product(n, n) - na * na / aa) * r * r;
  const Rational rest = s * s - along - across;
  return s >= 0 && rest >= 0 && rest * rest >= 4 * along * across;
}

template <typename Shape>
void expect_support_bounds(const Shape& shape, double room) {
  const CubeSupportBounds found = cube_support_bounds(shape, 13);
  for (std::size_t i = 0; i < 13; ++i) {
    for (const int sign : {1, -1}) {
      const double bound = sign > 0 ? found.up[i] : found.down[i];
      ASSERT_TRUE(std::isfinite(bound));
      const ExactPoint n = {sign * kCubeDirections[i][0], sign * kCubeDirections[i][1],
                            sign * kCubeDirections[i][2]};
      const Rational s = Rational(bound) - product(n, exact(shape.center()));
      ASSERT_TRUE(holds(s, n, shape)) << shape_name(shape) << " along " << i;
      ASSERT_FALSE(holds(s - Rational(room), n, shape)) << shape_name(shape) << " along " << i;
    }
  }
}

// The first at a right angle to the i-th direction, the third along it; unit and orthogonal but for `shear`.
Eigen::Matrix3d axes_at(Random& random, std::size_t i, double shear) {
  const Vector3d n =
      Vector3d(kCubeDirections[i][0], kCubeDirections[i][1], kCubeDirections[i][2]).normalized();
  Eigen::Matrix3d axes;
  axes.col(2) = n;
  axes.col(0) = n.cross(random.vector(1)).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  for (int k = 0; k < 3; ++k)
    axes.col(k) += random.vector(shear);
  return axes;
}

TEST(CubeSupportBounds, AreExactBoundsOfNeedlesAndPlatesAtRightAnglesToADirection) {
  Random random(71);
  for (int round = 0; round < 60; ++round) {
    const double shear = round % 3 == 0 ? 1e-13 : 0, size = std::exp(random.uniform(-7, 14));
    const Eigen::Matrix3d axes = axes_at(random, 3 + static_cast<std::size_t>(round) % 10, shear);
    const Vector3d center = round % 2 == 0 ? Vector3d(0, 0, 0) : random.vector(size);
    const double room = (0x1p-43 + 32 * shear) * size + 0x1p-48 * center.cwiseAbs().maxCoeff();
    for (const Vector3d& half :
         {Vector3d(1, 0, 0), Vector3d(1, 1e-9, 1e-9), Vector3d(1, 1, 1e-12), Vector3d(1, 0.1, 0)}) {
      ASSERT_NO_FATAL_FAILURE(expect_support_bounds(Obb(center, axes, size * half), room))
          << half.transpose();
      ASSERT_NO_FATAL_FAILURE(expect_support_bounds(Ellipsoid(center, axes, size * half), room))
          << half.transpose();
    }
    for (const double thin : {0.0, 1e-12, 1e-6}) {
      ASSERT_NO_FATAL_FAILURE(expect_support_bounds(Cylinder(center, axes.col(0), thin * size, size), room))
          << thin;
      ASSERT_NO_FATAL_FAILURE(expect_support_bounds(Cylinder(center, axes.col(2), size, thin * size), room))
          << thin;
    }
  }
}

TEST(CubeSupportBounds, AreExactBoundsOfRoundVolumesAndOfPoints) {
  Random random(72);
  for (const double radius : {0.0, 1e-3, 1.0, 3e5}) {
    const double room = 0x1p-43 * radius;
    const Vector3d zero = Vector3d::Zero(), least(1e-300, 1e-300, 1e-300);
    ASSERT_NO_FATAL_FAILURE(expect_support_bounds(Sphere(zero, radius), room + 1e-300));
    ASSERT_NO_FATAL_FAILURE(expect_support_bounds(
        Ellipsoid(zero, random.isometry(1).linear(), radius * Vector3d(1, 0.4, 0.2) + least), room + 1e-299));
    ASSERT_NO_FATAL_FAILURE(expect_support_bounds(
        Obb(zero, random.isometry(1).linear(), radius * Vector3d(1, 0.4, 0.2)), room + 1e-300));
    ASSERT_NO_FATAL_FAILURE(
        expect_support_bounds(Cylinder(zero, random.vector(1), radius, 0.5 * radius), room + 1e-300));
  }
  const Capsule capsule({1, 2, 3}, {4, -5, 6}, 0.5);
  const CubeSupportBounds found = cube_support_bounds(capsule, 13);
  for (std::size_t i = 0; i < 13; ++i) {
    const Vector3d n(kCubeDirections[i][0], kCubeDirections[i][1], kCubeDirections[i][2]);
    const double grown = 0.5 * std::sqrt(n.squaredNorm());
    EXPECT_NEAR(found.up[i], std::max(n.dot(capsule.a()), n.dot(capsule.b())) + grown, 1e-12);
    EXPECT_NEAR(found.down[i], grown - std::min(n.dot(capsule.a()), n.dot(capsule.b())), 1e-12);
  }
}

TEST(CubeSupportBounds, OfAKdopAreItsOwnSlabsWhateverTheirPlaceInTheSet) {
  const auto set = std::make_shared<const KdopSet>(
      std::vector<Vector3d>{{1, 1, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 1, -1}});
  Random random(73);
  const Kdop kdop = around(Kdop(set), random.cloud(scales()[1], Span::solid, 20));
  const CubeSupportBounds found = cube_support_bounds(kdop, 13);
  for (const auto& [slab, i] : {std::pair{0, 3}, std::pair{4, 12}}) {
    EXPECT_EQ(found.up[static_cast<std::size_t>(i)], kdop.max(static_cast<std::size_t>(slab)));
    EXPECT_EQ(found.down[static_cast<std::size_t>(i)], -kdop.min(static_cast<std::size_t>(slab)));
  }
}

}  // namespace
}  // namespace pcl_bv
