// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What trees go by instead of the thing itself: never on the wrong side of it, and off by the margin that is
// named.

#include <gtest/gtest.h>

#include <cmath>

#include "any_volumes.h"
#include "body_distance.h"
#include "rotatable.h"
#include "sphere_around.h"
#include "transformed_point.h"

namespace pcl_bv::detail {
namespace {

using namespace testing;

Vector3d corner_of(const Vector3d& low, const Vector3d& high, int i) {
  return {i & 1 ? low.x() : high.x(), i & 2 ? low.y() : high.y(), i & 4 ? low.z() : high.z()};
}
using Long = long double;

const double kPlaces[] = {0, 1e-3, 1, 1e6};

TEST(PlainBox, HoldsTheBoxOfAGroupAndLittleMore) {
  Random random(2);
  for (const double place : kPlaces) {
    for (const int power : {-20, 0, 9, 300}) {
      BoxLevels boxes;
      boxes.origin = coordinates(random.vector(place));
      boxes.scale = std::ldexp(1.0, power);
      BoxGroup group;
      for (std::size_t k = 0; k < kTreeWidth; ++k) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          group.low[axis][k] = static_cast<float>(random.uniform(-1, 1));
          group.high[axis][k] = group.low[axis][k] + static_cast<float>(random.uniform(0, 1e-3));
        }
        const PlainBox box = plain_box(boxes, group, k);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const auto gap = [&](float from, double to) {
            return test::Rational(to) - test::Rational(from) / test::Rational(boxes.scale) -
                   test::Rational(boxes.origin[axis]);
          };
          const double low = box.low[static_cast<int>(axis)], high = box.high[static_cast<int>(axis)];
          EXPECT_LE(gap(group.low[axis][k], low), 0);
          EXPECT_GE(gap(group.low[axis][k], low), test::Rational(-0x1p-51 * std::abs(low)));
          EXPECT_GE(gap(group.high[axis][k], high), 0);
          EXPECT_LE(gap(group.high[axis][k], high), test::Rational(0x1p-51 * std::abs(high)));
        }
      }
    }
  }
}

TEST(TransformedPoint, IsWithinItsErrorOfTheExactOne) {
  Random random(3);
  for (const double place : kPlaces) {
    for (const double shift : kPlaces) {
      for (int round = 0; round < 50; ++round) {
        const Eigen::Isometry3d pose = random.isometry(shift);
        const Vector3d p = random.vector(place);
        const TransformedPoint found = transform_point(pose, coordinates(p));
        EXPECT_LE(squared_distance(exact(vector(found.position)), image(pose, exact(p))),
                  test::Rational(found.error) * test::Rational(found.error));
        const Long sizes = (pose.linear().cwiseAbs() * p.cwiseAbs()).sum() + pose.translation().lpNorm<1>();
        EXPECT_NEAR(static_cast<double>(found.error / (0x1p-50L * sizes + 0x1p-500L)), 1, 1e-9);
      }
    }
  }
}

TEST(Stretch, IsThatOfTheGreatestStretchedVector) {
  Random random(4);
  for (int round = 0; round < 200; ++round) {
    Eigen::Isometry3d pose = random.isometry(1);
    const double turned = max_stretch(pose);
    EXPECT_GT(turned, 1 + 0x1.8p-46);
    EXPECT_LT(turned, 1 + 0x1.4p-45);
    if (round % 2 == 0) pose.linear().array() += random.uniform(-1, 1);
    const double greatest = pose.linear().jacobiSvd().singularValues()[0];
    EXPECT_GE(max_stretch(pose), greatest);
    EXPECT_LE(max_stretch(pose), std::sqrt(3.0) * greatest * (1 + 1e-12));
  }
  Eigen::Isometry3d uneven(Eigen::AngleAxisd(0, Vector3d::UnitX()));
  uneven.linear().diagonal() = Vector3d(1, 3, 2);
  EXPECT_EQ(max_stretch(uneven), 3 * (1 + 0x1p-45));
}

TEST(SphereAround, HoldsTheBoxAndLittleMore) {
  Random random(5);
  for (const double place : kPlaces) {
    for (const double size : kPlaces) {
      for (int round = 0; round < 50; ++round) {
        const Vector3d middle = random.vector(place), half = random.vector(size).cwiseAbs();
        const Vector3d low = middle - half, high = middle + half;
        const Sphere sphere = sphere_around({coordinates(low), coordinates(high)});
        for (int corner = 0; corner < 8; ++corner) {
          const Vector3d p = corner_of(low, high, corner);
          ASSERT_TRUE(inside(sphere, exact(p)));
        }
        const Long reach = (high.cast<Long>() - low.cast<Long>()).norm() / 2,
                   more = 0x1p-45L * (reach + low.lpNorm<1>() + high.lpNorm<1>());
        EXPECT_GE(sphere.radius(), reach + 0.8L * more);
        EXPECT_LE(sphere.radius(), reach + 1.2L * more + kSmallestNormal);
      }
    }
  }
  EXPECT_EQ(sphere_around({{0, 0, 0}, {0, 0, 0}}), Sphere({0, 0, 0}, kSmallestNormal));
  EXPECT_TRUE(sphere_around({{1, 1, 1}, {0, 0, 0}}).empty());
  EXPECT_TRUE(sphere_around({{0, 0, 0}, {1, 1, kInfinity}}).empty());
  EXPECT_TRUE(sphere_around({{0, -kInfinity, 0}, {1, 1, 1}}).empty());
}

TEST(Rotatable, AKdopsPlanesMoveOutwardByTheirRoundingAlone) {
  Random random(6);
  for (const double place : kPlaces) {
    for (const double size : kPlaces) {
      const std::vector<Vector3d> cloud = random.cloud({"", place, size}, Span::solid, 20);
      for (const auto& set : kdop_sets()) {
        const Kdop kdop = around(Kdop(set), cloud);
        const Hull hull = std::get<Hull>(rotatable(kdop));
        ASSERT_EQ(hull.planes().size(), 2 * kdop.size());
        const Long doubt =
            0x1p-48L * (kdop.aabb().min().lpNorm<1>() + kdop.aabb().max().lpNorm<1>()) + kSmallestNormal;
        for (std::size_t i = 0; i < 2 * kdop.size(); ++i) {
          const Long length = kdop.set()->direction(i / 2).cast<Long>().norm(),
                     offset = (i % 2 == 0 ? kdop.max(i / 2) : -kdop.min(i / 2)) / length;
          EXPECT_GE(hull.planes()[i].offset, offset + 0.8L * doubt);
          EXPECT_LE(hull.planes()[i].offset, offset + 1.2L * doubt);
        }
        for (const Vector3d& p : cloud)
          ASSERT_TRUE(inside(hull, exact(p)));
      }
    }
  }
}

TEST(BodyDistance, OfABoxIsThatOfItsMiddleLessItsReachAndAMargin) {
  Random random(7);
  for (const double place : kPlaces) {
    for (const AnyVolume& volume : volumes_of_every_kind(random, {"", place, 1})) {
      const BodyDistance body(volume);
      for (const double size : kPlaces) {
        const Vector3d middle = center(volume) + random.vector(10 * size + 3),
                       half = random.vector(size).cwiseAbs(), low = middle - half, high = middle + half,
                       at = 0.5 * (low + high);
        const double least = body.lower_bound({low, high}), away = distance(ConvexBody(volume), at);
        const Long reach = (high.cast<Long>() - low.cast<Long>()).norm() / 2,
                   margin = 0x1p-36L * (away + reach + aabb(volume).min().lpNorm<1>() +
                                        aabb(volume).max().lpNorm<1>() + at.lpNorm<1>());
        EXPECT_GE(least, away - reach - 1.01L * margin);
        EXPECT_LE(least, away - reach - 0.99L * margin);
        for (int corner = 0; corner < 8; ++corner) {
          const Vector3d p = corner_of(low, high, corner);
          EXPECT_LE(least, body.distance_to(p));
        }
      }
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail
