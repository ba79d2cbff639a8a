// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Claims of Cylinder, Capsule, Ellipsoid and Hull, the same for all and at every scale: what contains, moves,
// boxes and clips them errs only outward. Judged in rationals.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "obbs.h"
#include "round_volumes.h"

namespace pcl_bv::detail {
namespace {

using Eigen::Vector3d;
using testing::exact;
using testing::ExactPoint;
using testing::Random;
using testing::Rational;
using testing::volumes;

bool exactly_inside(const AnyVolume& volume, const ExactPoint& p) {
  return std::visit([&](const auto& v) { return testing::inside(v, p); }, volume);
}

// Points near the surface, on either side of it, by rounding or clearly.
std::vector<Vector3d> points_about(const AnyVolume& volume, Random& random) {
  std::vector<Vector3d> points;
  for (int i = 0; i < 40; ++i) {
    Vector3d normal = random.vector(1);
    // All over a thin ellipsoid, whose tips are farthest along nearly all directions.
    if (const auto* e = std::get_if<Ellipsoid>(&volume))
      normal = e->axes() * normal.cwiseQuotient(e->radii() / e->radii().maxCoeff());
    const Vector3d rim = support(volume, normal);
    const double part = i % 4 == 0 ? 1 : i % 4 == 1 ? 1 - 1e-15 : random.uniform(0, 1.05);
    points.push_back(center(volume) + part * (rim - center(volume)));
  }
  return points;
}

class RoundVolumesAtScales : public ::testing::TestWithParam<testing::Scale> {};

TEST_P(RoundVolumesAtScales, ContainWhatIsExactlyInside) {
  Random random(1);
  int in = 0, out = 0;
  for (int i = 0; i < 20; ++i) {
    for (const AnyVolume& volume : volumes(random, GetParam())) {
      for (const Vector3d& p : points_about(volume, random)) {
        if (exactly_inside(volume, exact(p))) {
          EXPECT_TRUE(contains(volume, p)) << shape_name(volume);
          EXPECT_EQ(distance(volume, p), 0);
          ++in;
        } else if (!contains(volume, p)) {
          ++out;
        }
      }
    }
  }
  EXPECT_GT(in, 100);
  if (GetParam().extent > 1e-9 * GetParam().offset) {
    EXPECT_GT(out, 10);
  }
}

TEST_P(RoundVolumesAtScales, MoveWithTheirPoints) {
  Random random(2);
  for (int i = 0; i < 10; ++i) {
    const Eigen::Isometry3d motion = random.isometry(GetParam().extent);
    for (const AnyVolume& volume : volumes(random, GetParam())) {
      const AnyVolume moved = transformed(volume, motion);
      EXPECT_EQ(shape_name(moved), shape_name(volume));
      for (const Vector3d& p : points_about(volume, random)) {
        if (!exactly_inside(volume, exact(p))) continue;
        EXPECT_TRUE(exactly_inside(moved, testing::image(motion, exact(p)))) << shape_name(volume);
      }
      if (GetParam().offset == 0 && std::abs(std::log10(GetParam().extent)) < 90) {
        EXPECT_NEAR(pcl_bv::volume(moved) / pcl_bv::volume(volume), 1, 1e-9) << shape_name(volume);
      }
    }
  }
}

TEST_P(RoundVolumesAtScales, AreInTheirBoxes) {
  Random random(3);
  for (int i = 0; i < 20; ++i) {
    for (const AnyVolume& volume : volumes(random, GetParam())) {
      const Aabb box = aabb(volume);
      for (const Vector3d& p : points_about(volume, random)) {
        if (exactly_inside(volume, exact(p))) {
          EXPECT_TRUE(box.contains(p)) << shape_name(volume);
        }
      }
      for (int k = 0; k < 3; ++k) {  // and the boxes touch
        const double reach = support(volume, Vector3d::Unit(k))[k];
        EXPECT_NEAR(box.max()[k], reach, 1e-11 * GetParam().extent + 1e-15 * std::abs(reach))
            << shape_name(volume);
      }
    }
  }
}

// The ends of the axis, of cylinders without a radius: what rounding moves, only the radius can cover.
TEST_P(RoundVolumesAtScales, InfiniteFloatCylindersHoldTheAxis) {
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    Vector3d axis = random.vector(1);
    if (i % 2 == 0) axis = Vector3d(1, std::ldexp(random.uniform(-1, 1), -5 * i), 0);
    const Cylinder cylinder(random.point(GetParam()), axis, 0, GetParam().extent);
    const FloatCylinder copy = cylinder.cast_float();
    if (!std::isfinite(copy.radius)) continue;
    for (const double end : {-0.999999999, 0.999999999}) {
      ExactPoint q;
      for (int k = 0; k < 3; ++k)
        q[static_cast<std::size_t>(k)] = Rational(cylinder.center()[k]) - Rational(copy.center[k]) +
                                         Rational(end * GetParam().extent) * Rational(cylinder.axis()[k]);
      const ExactPoint a = exact(copy.axis.cast<double>());
      const Rational along = testing::product(q, a), aa = testing::product(a, a), r(copy.radius);
      EXPECT_TRUE(testing::product(q, q) * aa - along * along <= r * r * aa) << i;
    }
  }
}

TEST_P(RoundVolumesAtScales, AreEnteredAtZeroByRaysFromPointsThatTheyContain) {
  Random random(5);
  for (int i = 0; i < 20; ++i) {
    for (const AnyVolume& volume : volumes(random, GetParam())) {
      for (int k = 0; k < 20; ++k) {
        // On the surface, or within what contains() allows for.
        const Vector3d outward = random.vector(1);
        Vector3d p = support(volume, outward);
        for (int axis = 0; axis < 3; ++axis) {
          if (random.uniform(0, 1) < 0.5) p[axis] = std::nextafter(p[axis], outward[axis] * std::numeric_limits<double>::infinity());
        }
        if (!contains(volume, p)) continue;
        for (const Vector3d& direction : {random.vector(1), outward}) {
          const auto hit = intersect(volume, p, direction);
          ASSERT_TRUE(hit) << shape_name(volume) << ", seed 5, " << i << ", " << k;
          EXPECT_EQ(hit->enter, 0) << shape_name(volume);
        }
      }
    }
  }
}

TEST_P(RoundVolumesAtScales, AreHitByRaysThroughPointsInside) {
  Random random(4);
  for (int i = 0; i < 20; ++i) {
    for (const AnyVolume& volume : volumes(random, GetParam())) {
      for (const Vector3d& target : points_about(volume, random)) {
        if (!exactly_inside(volume, exact(target))) continue;
        // So near a power of two that origin + direction is the target, exactly.
        const Vector3d origin = target + random.vector(4 * GetParam().extent), direction = target - origin;
        if (Vector3d(origin + direction) != target ||
            exact(origin)[0] + exact(direction)[0] != exact(target)[0])
          continue;
        const auto hit = intersect(volume, origin, direction);
        ASSERT_TRUE(hit.has_value()) << shape_name(volume);
        EXPECT_LE(hit->enter, 1 + 1e-12) << shape_name(volume);
        EXPECT_GE(hit->exit, 1 - 1e-12) << shape_name(volume);
      }
    }
  }
}

TEST(RoundVolumes, ACapsuleContainsPointsOnItWhoseTaxicabLengthIsHardlyItsRadius) {
  // Then size and radius are alike: no difference of them would do for what rounding may take.
  Random random(6);
  for (int i = 0; i < 1000; ++i) {
    const Vector3d p(random.uniform(1, 2), random.uniform(0, 1e-3), random.uniform(0, 1e-3));
    const double radius = test::least_root_above(testing::product(exact(p), exact(p)), p.norm());
    ASSERT_TRUE(Capsule({0, 0, 0}, {0, 0, 0}, radius).contains(p)) << "seed 6, " << i;
  }
}

TEST(RoundVolumes, RaysEndInAnEllipsoidThatIsGreaterByNoMoreThanIsSaid) {
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Matrix3d axes = random.isometry(1).linear();
    const Vector3d origin = random.vector(20), radii(1, 1, i % 2 == 0 ? 1 : 0.5);
    // Through the centre, where the sphere of a ball's coordinates is cut at right angles.
    const auto hit = Ellipsoid({0, 0, 0}, axes, radii).intersect(origin, -origin);
    ASSERT_TRUE(hit);
    const double room = 0x1p-44 * (origin.lpNorm<1>() + 1) / radii.minCoeff();
    const Ellipsoid greater({0, 0, 0}, axes, radii + Vector3d::Constant(room));
    for (const double t : {hit->enter, hit->exit}) {
      const Rational left = Rational(1) - Rational(t);
      const ExactPoint o = exact(origin);
      EXPECT_TRUE(testing::inside(greater, {o[0] * left, o[1] * left, o[2] * left})) << "seed 7, " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, RoundVolumesAtScales, ::testing::ValuesIn(testing::scales()),
                         [](const auto& scale) { return "n" + std::to_string(scale.index); });

// Where subtracting what is along the axis leaves nothing but rounding.
TEST(Cylinder, SupportAlongItsAxisIsOnAnEnd) {
  Random random(4);
  for (int i = 0; i < 1000; ++i) {
    const Cylinder c({0, 0, 0}, random.vector(1), 1, 1);
    for (const double tilt : {0.0, 1e-15, 1e-9}) {
      const Vector3d rim = c.support(c.axis() + tilt * random.vector(1));
      EXPECT_NEAR(rim.dot(c.axis()), 1, 1e-15);
      EXPECT_LE(rim.cross(c.axis()).norm(), 1 + 1e-15);
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail
