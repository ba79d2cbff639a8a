// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Inflated volumes hold all that is within the padding, in rationals, and no more than is said.

#include "inflated.h"

#include <gtest/gtest.h>

#include "any_volumes.h"

namespace pcl_bv::detail {
namespace {

using namespace testing;

bool holds(const AnyVolume& volume, const Vector3d& point) {
  return std::visit([&](const auto& shape) { return inside(shape, exact(point)); }, volume);
}

// Points of the volume, by exact arithmetic: as near its surface as rounding lets them be.
std::vector<Vector3d> points_of(Random& random, const AnyVolume& volume) {
  std::vector<Vector3d> points;
  for (int i = 0; i < 12; ++i) {
    const Vector3d middle = center(volume), far = support(volume, random.vector(1)) - middle;
    for (const double inward : {0.0, 0x1p-50, 0x1p-30, 0.5, 1.0}) {
      const Vector3d point = middle + (1 - inward) * far;
      if (holds(volume, point)) points.push_back(point);
    }
  }
  return points;
}

TEST(Inflated, HoldsWhateverIsWithinThePaddingByExactArithmetic) {
  Random random(1);
  for (const Scale& scale : scales()) {
    std::size_t tried = 0;
    for (const AnyVolume& volume : volumes_of_every_kind(random, scale)) {
      for (const double part : {1e-6, 0.1, 3.0}) {
        const double padding = part * scale.extent;
        const AnyVolume larger = inflated(volume, padding);
        ASSERT_EQ(larger.index(), volume.index());
        for (const Vector3d& point : points_of(random, volume)) {
          const Vector3d outward = point - center(volume), any = random.vector(1);
          for (const Vector3d& way : {any, outward.isZero(0) ? any : outward}) {
            const Vector3d moved = point + way.stableNormalized() * (padding * (1 - 0x1p-51));
            if (squared_distance(exact(point), exact(moved)) > Rational(padding) * Rational(padding))
              continue;
            ++tried;
            ASSERT_TRUE(holds(larger, moved)) << shape_name(volume) << ", " << scale.name << ", " << padding;
          }
        }
      }
    }
    EXPECT_GT(tried, 500u) << scale.name;
  }
}

TEST(Inflated, BoxesSpheresAndRoundOnesGrowByThePadding) {
  const Vector3d c(1, -2, 3), up(0, 0, 1), size(0.5, 0.25, 2);
  Eigen::Matrix3d turned;
  turned << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  EXPECT_EQ(inflated(Aabb(c - size, c + size), 0.125),
            AnyVolume(Aabb((c - size).array() - 0.125, (c + size).array() + 0.125)));
  EXPECT_EQ(inflated(Sphere(c, 2), 0.125), AnyVolume(Sphere(c, 2.125)));
  EXPECT_EQ(inflated(Obb(c, turned, size), 0.125), AnyVolume(Obb(c, turned, size.array() + 0.125)));
  EXPECT_EQ(inflated(Cylinder(c, up, 2, 3), 0.125), AnyVolume(Cylinder(c, up, 2.125, 3.125)));
  EXPECT_EQ(inflated(Capsule(c, up, 2), 0.125), AnyVolume(Capsule(c, up, 2.125)));
}

TEST(Inflated, PlanesMoveOutwardByThePaddingWhateverTheLengthOfTheirNormals) {
  const auto set = std::make_shared<const KdopSet>(
      std::vector<Vector3d>{{3, 4, 0}, {0, 5, 12}, {1, 0, 0}});  // of lengths 5, 13 and 1
  SlabVector min(3), max(3);
  min << -1, -2, -3;
  max << 1, 2, 3;
  const Kdop larger = std::get<Kdop>(inflated(Kdop(set, min, max), 0.5));
  EXPECT_EQ(larger.min(), SlabVector(min - Vector3d(2.5, 6.5, 0.5)));
  EXPECT_EQ(larger.max(), SlabVector(max + Vector3d(2.5, 6.5, 0.5)));
  const Hull hull = std::get<Hull>(inflated(cube({0, 0, 0}, 2), 0.5));
  for (const HullPlane& plane : hull.planes())
    EXPECT_EQ(plane.offset, plane.normal.sum() > 0 ? 2.5 : 0.5);
}

TEST(Inflated, APrismGrowsByAtLeastThePaddingAndByTwoPercentMoreAtMost) {
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    const Prism prism = testing::prism_around(random.cloud({"", 3, 1}, Span::solid, 3 + i % 20),
                                              orthonormal_axes(random.isometry(1).linear()));
    const Prism larger = std::get<Prism>(inflated(prism, 0.25));
    EXPECT_NEAR(larger.high() - prism.high(), 0.25, 1e-12);
    EXPECT_NEAR(prism.low() - larger.low(), 0.25, 1e-12);
    for (int k = 0; k < 50; ++k) {
      const double angle = 0.1 * k;
      const Vector3d outward = std::cos(angle) * prism.axes().col(0) + std::sin(angle) * prism.axes().col(1);
      const double step = outward.dot(larger.support(outward) - prism.support(outward));
      EXPECT_GE(step, 0.25 - 1e-12) << "seed 4, " << i;
      EXPECT_LE(step, 0.25 * 1.02) << "seed 4, " << i;
    }
  }
}

TEST(Inflated, AnEllipsoidOfEqualRadiiGrowsLikeASphere) {
  const Ellipsoid ball({1, 2, 3}, Eigen::Matrix3d::Identity(), {2, 2, 2});
  const Vector3d radii = std::get<Ellipsoid>(inflated(ball, 0.5)).radii();
  EXPECT_TRUE(((radii.array() - 2.5).abs() < 2.5e-12).all()) << radii.transpose();
  const Ellipsoid point({1, 2, 3}, Eigen::Matrix3d::Identity(), {0, 0, 0});
  const Vector3d around_it = std::get<Ellipsoid>(inflated(point, 0.5)).radii();
  EXPECT_TRUE(((around_it.array() - 0.5).abs() < 1e-11).all()) << around_it.transpose();
}

TEST(Inflated, AnEllipsoidIsNearlyTheLeastOfItsKind) {
  for (const Vector3d& radii : {Vector3d(1, 0.05, 0.05), Vector3d(1, 1, 0.01), Vector3d(3, 2, 1),
                                Vector3d(1, 0, 0), Vector3d(1, 0.3, 0)}) {
    for (const double padding : {1e-3, 0.05, 2.0}) {
      double least = kInfinity;
      for (double m = 1e-4; m < 4; m *= 1.01) {
        const Eigen::Array3d squares = radii.array().square();
        least = std::min(least, (squares + padding * (padding + m + squares / m)).sqrt().prod());
      }
      const Ellipsoid ellipsoid({0, 0, 0}, Eigen::Matrix3d::Identity(), radii);
      const Vector3d larger = std::get<Ellipsoid>(inflated(ellipsoid, padding)).radii();
      EXPECT_LE(larger.prod(), 1.001 * least) << radii.transpose() << ", " << padding;
      EXPECT_TRUE((larger.array() >= radii.array() + padding * (1 - 1e-12)).all());
    }
  }
}

TEST(Inflated, WithoutPaddingOrContentsIsTheVolumeItself) {
  Random random(2);
  for (const AnyVolume& volume : volumes_of_every_kind(random, scales().front()))
    EXPECT_EQ(inflated(volume, 0), volume) << shape_name(volume);
  for (const AnyVolume& volume :
       {AnyVolume(Aabb()), AnyVolume(Kdop()), AnyVolume(Sphere()), AnyVolume(Obb()), AnyVolume(Cylinder()),
        AnyVolume(Capsule()), AnyVolume(Ellipsoid()), AnyVolume(Hull()), AnyVolume(Prism())}) {
    EXPECT_TRUE(empty(inflated(volume, 1))) << shape_name(volume);
  }
}

}  // namespace
}  // namespace pcl_bv::detail
