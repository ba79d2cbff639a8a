// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Claims of the oriented box.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "exact.h"
#include "obbs.h"
#include "pcl_bv/volumes/obb.h"

namespace pcl_bv::detail {
namespace {

using namespace pcl_bv::testing;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(Obb, DefaultIsEmptyAndHoldsNothing) {
  const Obb box;
  EXPECT_TRUE(box.empty());
  EXPECT_TRUE(box.center().hasNaN());
  EXPECT_EQ(box.half_extents(), Vector3d(-1, -1, -1));
  EXPECT_FALSE(box.contains(Vector3d::Zero()));
  EXPECT_EQ(box.volume(), 0);
  EXPECT_EQ(box.surface_area(), 0);
  EXPECT_EQ(box.distance(Vector3d::Zero()), infinity);
  EXPECT_TRUE(box.support(Vector3d::UnitX()).hasNaN());
  EXPECT_TRUE(box.corners()[0].hasNaN());
  EXPECT_TRUE(box.aabb().empty());
  EXPECT_TRUE(box.mesh().vertices.empty());
  EXPECT_TRUE(box.transformed(Eigen::Isometry3d::Identity()).empty());
  EXPECT_TRUE(box.canonical().empty() && box.oriented_as(box).empty());
  EXPECT_EQ(box.cast_float().half_extents.x(), -1);
  EXPECT_EQ(box, Obb({1, 2, 3}, Matrix3d::Identity(), {1, -1, 1}));
  EXPECT_EQ(box, Obb(Aabb()));
  EXPECT_FALSE(box.intersect(Vector3d::Zero(), Vector3d::UnitX()));
}

TEST(Obb, RefusesWhatIsNoBox) {
  const Matrix3d axes = Matrix3d::Identity();
  EXPECT_THROW(Obb({nan, 0, 0}, axes, {1, 1, 1}), std::invalid_argument);
  EXPECT_THROW(Obb({0, 0, 0}, axes, {1, infinity, 1}), std::invalid_argument);
  EXPECT_THROW(Obb({0, 0, 0}, 2 * axes, {1, 1, 1}), std::invalid_argument);
  EXPECT_THROW(Obb({0, 0, 0}, axes * (1 + 1e-11), {1, 1, 1}), std::invalid_argument);
  Matrix3d skew = axes;
  skew(0, 1) = 1e-11;
  EXPECT_THROW(Obb({0, 0, 0}, skew, {1, 1, 1}), std::invalid_argument);
  skew(0, 1) = nan;
  EXPECT_THROW(Obb({0, 0, 0}, skew, {1, 1, 1}), std::invalid_argument);
  skew(0, 1) = 1e-13;
  EXPECT_NO_THROW(Obb({0, 0, 0}, skew, {1, 1, 1}));
}

TEST(Obb, TurnsTheLastOfLeftHandedAxesAndStoresNoNegativeZero) {
  const Obb box({-0.0, 0, 0}, -Matrix3d::Identity(), {1, 2, -0.0});
  EXPECT_EQ(box.axes().determinant(), 1);
  EXPECT_EQ(box.axis(2), Vector3d::UnitZ());
  for (const double x : box.axes().reshaped())
    EXPECT_FALSE(x == 0 && std::signbit(x));
  EXPECT_FALSE(std::signbit(box.center().x()) || std::signbit(box.half_extents().z()));
}

TEST(Obb, MeasuresAreThoseOfTheFormulas) {
  Matrix3d axes;
  axes << 0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, 1;
  const Obb box({1, 2, 3}, axes, {5, 2, 1});
  EXPECT_DOUBLE_EQ(box.volume(), 80);
  EXPECT_DOUBLE_EQ(box.surface_area(), 2 * (10 * 4 + 4 * 2 + 2 * 10));
  EXPECT_TRUE(box.support({3, 4, 5}).isApprox(Vector3d(1 + 3 - 1.6, 2 + 4 + 1.2, 4)) ||
              box.support({3, 4, 5}).isApprox(Vector3d(1 + 3 + 1.6, 2 + 4 - 1.2, 4)));
  EXPECT_NEAR(box.distance(box.center() + 7 * box.axis(0)), 2, 1e-14);
  EXPECT_NEAR(box.distance(box.center() + 8 * box.axis(0) + 6 * box.axis(1)), 5, 1e-14);
  EXPECT_EQ(box.distance(box.center()), 0);
  EXPECT_TRUE(std::isnan(box.distance({nan, 0, 0})));
  for (unsigned i = 0; i < 8; ++i) {
    const Vector3d own = box.axes().transpose() * (box.corners()[i] - box.center());
    EXPECT_TRUE(own.isApprox(Vector3d(i & 1 ? 5 : -5, i & 2 ? 2 : -2, i & 4 ? 1 : -1))) << i;
  }
  EXPECT_EQ(Obb(box.pose(), box.half_extents()), box);
  EXPECT_TRUE(box.quaternion().toRotationMatrix().isApprox(axes, 1e-15));
  EXPECT_GT(box.quaternion().w(), 0);
  const Obb half_turn({0, 0, 0}, Vector3d(1, -1, -1).asDiagonal().toDenseMatrix(), {1, 1, 1});
  EXPECT_EQ(half_turn.quaternion().coeffs(), Eigen::Vector4d(1, 0, 0, 0));
}

TEST(Obb, QuaternionHasAPositiveRealPartAlsoNearAHalfTurn) {
  for (int k = 0; k < 3; ++k) {
    for (const double angle : {-3.0, 3.0}) {
      const Matrix3d axes = Eigen::AngleAxisd(angle, Vector3d::Unit(k)).toRotationMatrix();
      const Eigen::Quaterniond q = Obb({0, 0, 0}, axes, {1, 1, 1}).quaternion();
      EXPECT_GT(q.w(), 0) << k << ", " << angle;
      EXPECT_TRUE(q.toRotationMatrix().isApprox(axes, 1e-15)) << k << ", " << angle;
    }
  }
}

TEST(Obb, MeshFacesLookOutward) {
  Random random(3);
  for (int i = 0; i < 20; ++i) {
    const Obb box = random_obb(random, scales()[0]);
    const Mesh mesh = box.mesh();
    ASSERT_EQ(mesh.faces.size(), 6U);
    for (const auto& face : mesh.faces) {
      const auto at = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(face[k])]; };
      const Vector3d normal = (at(1) - at(0)).cross(at(2) - at(0));
      EXPECT_GT(normal.dot(at(0) - box.center()), 0);
    }
  }
}

TEST(Obb, ContainsPointsExactlyOnItAtEverySize) {
  Random random(11);
  int by_a_hair = 0;
  for (const Scale& scale : scales()) {
    SCOPED_TRACE(scale.name);
    for (int i = 0; i < 200; ++i) {
      const Obb frame = random_obb(random, scale);
      const Vector3d p = random.point(scale);
      const Obb box(frame.center(), frame.axes(), exact_half_extents(frame, p));
      ASSERT_TRUE(box.contains(p)) << i;
      const Vector3d q = frame.axes().transpose() * (p - frame.center());
      by_a_hair += (q.array().abs() > box.half_extents().array()).any();
      if (scale.extent > 1e-150) {
        const double slack = 1e-14 * ((p - frame.center()).lpNorm<1>());
        EXPECT_FALSE(
            Obb(frame.center(), frame.axes(), (box.half_extents().array() - slack).max(0)).contains(p));
      }
    }
  }
  EXPECT_GT(by_a_hair, 0) << "the cases are too easy";
  for (int k = 0; k < 3; ++k)
    EXPECT_FALSE(Obb(Aabb({-1, -1, -1}, {1, 1, 1})).contains(nan * Vector3d::Unit(k)));
}

TEST(Obb, FromSlabsHoldsAllOfTheSlabsAndIsTight) {
  Random random(12);
  for (const Scale& scale : scales()) {
    SCOPED_TRACE(scale.name);
    for (int i = 0; i < 100; ++i) {
      const Matrix3d axes = random.isometry(1).linear();
      const Vector3d a = axes.transpose() * random.point(scale), b = axes.transpose() * random.point(scale);
      const Vector3d low = a.cwiseMin(b), high = a.cwiseMax(b);
      const Obb box = Obb::from_slabs(axes, low, high);
      for (int k = 0; k < 3; ++k) {
        const Rational middle = dot(axes.col(k), exact(box.center()));
        ASSERT_LE(middle - Rational(box.half_extents()[k]), Rational(low[k]));
        ASSERT_GE(middle + Rational(box.half_extents()[k]), Rational(high[k]));
        const double magnitude = std::abs(low[k]) + std::abs(high[k]) + box.center().lpNorm<1>();
        EXPECT_LE(box.half_extents()[k], (high[k] - low[k]) / 2 + 4e-16 * magnitude + 1e-300);
      }
    }
  }
  EXPECT_TRUE(Obb::from_slabs(Matrix3d::Identity(), {0, 0, 1}, {1, 1, 0}).empty());
}

TEST(Obb, OfAnAabbIsThatBox) {
  const Aabb box({5e6, -1, 2}, {5e6 + 3, 1, 2});
  const Obb oriented(box);
  EXPECT_EQ(oriented.aabb(), box);
  EXPECT_EQ(oriented.axes(), Matrix3d::Identity());
  EXPECT_EQ(oriented.half_extents(), Vector3d(1.5, 1, 0));
}

TEST(Obb, AabbAndTransformedAndFloatCopyHoldItByExactArithmetic) {
  Random random(13);
  for (const Scale& scale : scales()) {
    SCOPED_TRACE(scale.name);
    for (int i = 0; i < 60; ++i) {
      const Obb box = random_obb(random, scale);
      const Eigen::Isometry3d move = random.isometry(scale.extent);
      const Obb moved = box.transformed(move);
      const FloatObb small = box.cast_float();
      const double size = box.half_extents().sum(), far = box.center().lpNorm<1>() + size;
      EXPECT_LE((moved.half_extents() - box.half_extents()).maxCoeff(), 1e-14 * size + 4e-15 * far);
      for (const ExactPoint& corner : exact_corners(box)) {
        ASSERT_TRUE(inside(box.aabb(), corner)) << i;
        ASSERT_TRUE(inside(moved, image(move, corner))) << i;
        if (scale.extent < 1e37) {
          ASSERT_TRUE(inside(small, corner)) << i;
        }
      }
      if (scale.extent > 1e-30 && scale.extent < 1e37) {
        const Vector3d added = small.half_extents.cast<double>() - box.half_extents();
        EXPECT_LE(added.maxCoeff(), 1e-6 * (size + far)) << i;
      }
      const Vector3d reach = box.aabb().max() - box.aabb().min();
      const Vector3d expected = 2 * box.axes().cwiseAbs() * box.half_extents();
      EXPECT_LE((reach - expected).maxCoeff(), 1e-14 * size + 4e-16 * far);
      EXPECT_GE(reach.x(), expected.x() * (1 - 1e-14));
    }
  }
}

TEST(Obb, OfFloatsBeyondTheirRangeIsInfinite) {
  const FloatObb copy = Obb(Aabb({0, 0, 0}, {1e60, 1, 1})).cast_float();
  EXPECT_TRUE(std::isinf(copy.half_extents.x()));
  EXPECT_TRUE(copy.center.allFinite());
}

TEST(Obb, MergedHoldsBothByExactArithmeticAndIsCommutative) {
  Random random(14);
  for (const Scale& scale : scales()) {
    SCOPED_TRACE(scale.name);
    for (int i = 0; i < 40; ++i) {
      const Obb a = random_obb(random, scale), b = random_obb(random, scale);
      const Obb merged = a.merged(b);
      EXPECT_EQ(merged, b.merged(a));
      for (const Obb& part : {a, b}) {
        for (const ExactPoint& corner : exact_corners(part))
          ASSERT_TRUE(inside(merged, corner)) << i;
      }
      EXPECT_EQ(a.merged(Obb()), a);
      EXPECT_EQ(Obb().merged(a), a);
    }
  }
  const Obb big({0, 0, 0}, random.isometry(1).linear(), {3, 4, 5});
  const Obb small({0.5, 0, 0}, random.isometry(1).linear(), {1, 1, 1});
  EXPECT_EQ(big.merged(small), big);
  EXPECT_EQ(small.merged(big), big);
}

TEST(Obb, OverlapsIsWhatSharedAndSeparatedPointsSay) {
  Random random(15);
  int together = 0, apart = 0, by_edges_only = 0;
  for (const Scale& scale : scales()) {
    if (scale.name == "utm, 1 mm")
      continue;  // there 4e-12 of the distance from the origin is no matter, but ulps are
    SCOPED_TRACE(scale.name);
    for (int i = 0; i < 200; ++i) {
      const Obb a = random_obb(random, scale), b = random_obb(random, scale);
      const bool overlap = a.overlaps(b);
      EXPECT_EQ(overlap, b.overlaps(a));
      (overlap ? together : apart)++;
      EXPECT_EQ(overlap, nearest_gap(a, b) <= 1e-6 * scale.extent) << i;
      by_edges_only += !overlap && !faces_separate(a, b);
      EXPECT_TRUE(a.overlaps(a));
    }
  }
  EXPECT_GT(together, 100);
  EXPECT_GT(apart, 100);
  EXPECT_GT(by_edges_only, 5) << "no case needs the cross products";
  EXPECT_FALSE(Obb().overlaps(Obb()));
}

TEST(Obb, OverlapsHoldsForBoxesThatTouch) {
  Random random(16);
  for (int i = 0; i < 100; ++i) {
    const Obb a = random_obb(random, scales()[0]);
    const Obb b(a.center() + 2 * a.half_extents().x() * a.axis(0), a.axes(), a.half_extents());
    EXPECT_TRUE(a.overlaps(b)) << i;
    const Obb c(a.center() + 2.0001 * a.half_extents().x() * a.axis(0), a.axes(), a.half_extents());
    EXPECT_FALSE(a.overlaps(c)) << i;
  }
}

TEST(Obb, OverlapsHoldsForASmallBoxThatTouchesALongOne) {
  const Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  for (int side = 0; side < 3; ++side) {
    const Obb small({0, 0, 0}, axes, {1, 1, 1});
    Vector3d half = Vector3d::Constant(100);
    half[side] = 1;
    const Obb plate(2 * Vector3d::Unit(side), axes, half);
    EXPECT_TRUE(small.overlaps(plate)) << side;
    EXPECT_TRUE(plate.overlaps(small)) << side;
  }
}

TEST(Obb, OverlapsHoldsForBoxesOfDenormalSizeThatTouch) {
  for (const double size : {5e-324, 1e-310, 1e-308}) {
    const Vector3d half = Vector3d::Constant(size);
    const Obb a({0, 0, 0}, Eigen::Matrix3d::Identity(), half);
    EXPECT_TRUE(a.overlaps({Vector3d(2 * size, 0, 0), Eigen::Matrix3d::Identity(), half})) << size;
    EXPECT_TRUE(a.overlaps({Vector3d(0, 2 * size, -2 * size), Eigen::Matrix3d::Identity(), half})) << size;
  }
}

TEST(Obb, IntersectNeverDeniesAHitAndIsTight) {
  Random random(17);
  for (const Scale& scale : scales()) {
    SCOPED_TRACE(scale.name);
    for (int i = 0; i < 100; ++i) {
      const Obb box = random_obb(random, scale);
      const Vector3d origin = box.center() + random.vector(3 * scale.extent);
      const Vector3d target = box.corners()[static_cast<std::size_t>(i) % 8];
      const Vector3d inner = box.center() + 0.999 * (target - box.center());
      const auto hit = box.intersect(origin, inner - origin);
      ASSERT_TRUE(hit) << i;
      EXPECT_LE(hit->enter, 1);
      EXPECT_GE(hit->exit, 1);
      const Vector3d outer = box.center() + 1.01 * (target - box.center());
      const auto away = box.intersect(outer, outer - box.center());
      EXPECT_FALSE(away && scale.name != "utm, 1 mm") << i;
    }
  }
  const Obb unit(Aabb({-1, -1, -1}, {1, 1, 1}));
  const auto through = unit.intersect({-3, 0, 0}, {1, 0, 0});
  ASSERT_TRUE(through);
  EXPECT_NEAR(through->enter, 2, 2e-14);
  EXPECT_NEAR(through->exit, 4, 2e-14);
  EXPECT_TRUE(unit.intersect({-3, 1, 1}, {1, 0, 0})) << "along an edge";
  EXPECT_EQ(unit.intersect({1, 1, 1}, {1, 1, 1})->enter, 0);
  EXPECT_TRUE(unit.intersect({1, 1, 1}, {0, 0, 0}));
  EXPECT_FALSE(unit.intersect({1, 1, 1.1}, {0, 0, 0}));
}

}  // namespace
}  // namespace pcl_bv::detail
