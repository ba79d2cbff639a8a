// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Claims of the axis-aligned box.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "exact.h"
#include "meshes.h"
#include "pcl_bv/volumes/aabb.h"

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace pcl_bv::detail {
namespace {

using namespace pcl_bv::testing;
using Eigen::Vector3d;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(Aabb, DefaultIsEmpty) {
  const Aabb box;
  EXPECT_TRUE(box.empty());
  EXPECT_EQ(box.min(), Vector3d::Constant(infinity));
  EXPECT_EQ(box.max(), Vector3d::Constant(-infinity));
}

TEST(Aabb, EmptyHasNoExtentAndHoldsNothing) {
  const Aabb box;
  EXPECT_EQ(box.volume(), 0);
  EXPECT_EQ(box.surface_area(), 0);
  EXPECT_FALSE(box.contains(Vector3d::Zero()));
  EXPECT_EQ(box.distance(Vector3d::Zero()), infinity);
  EXPECT_TRUE(box.center().hasNaN());
  EXPECT_TRUE(box.support(Vector3d::UnitX()).hasNaN());
  EXPECT_TRUE(box.mesh().vertices.empty());
  EXPECT_TRUE(box.transformed(Eigen::Isometry3d::Identity()).empty());
  EXPECT_EQ(box.cast_float().min, Eigen::Vector3f::Constant(std::numeric_limits<float>::infinity()));
}

TEST(Aabb, AnyMinAboveItsMaxIsTheEmptyBox) {
  EXPECT_EQ(Aabb({0, 0, 2}, {1, 1, 1}), Aabb());
  EXPECT_EQ(Aabb({infinity, infinity, infinity}, {-infinity, -infinity, -infinity}), Aabb());
}

TEST(Aabb, RefusesBoundsThatAreNotFinite) {
  EXPECT_THROW(Aabb({nan, 0, 0}, {1, 1, 1}), std::invalid_argument);
  EXPECT_THROW(Aabb({0, 0, 0}, {1, infinity, 1}), std::invalid_argument);
}

TEST(Aabb, StoresNoNegativeZero) {
  const Aabb box({-0.0, -1, -0.0}, {-0.0, -0.0, 1});
  EXPECT_FALSE(std::signbit(box.min().x()) || std::signbit(box.max().x()) || std::signbit(box.max().y()));
  EXPECT_FALSE(std::signbit(Aabb().extend({-0.0, 1, 1}).min().x()));
}

TEST(Aabb, ContainsItsFaceAndNotTheNextDouble) {
  const Aabb box({0.1, 0.1, 0.1}, {0.3, 0.3, 0.3});
  EXPECT_TRUE(box.contains({0.1, 0.3, 0.2}));
  EXPECT_FALSE(box.contains({0.2, std::nextafter(0.3, 1), 0.2}));
  EXPECT_FALSE(box.contains({0.2, 0.2, std::nextafter(0.1, 0)}));
}

TEST(Aabb, ContainsNoNaN) {
  const Aabb box({-1, -1, -1}, {1, 1, 1});
  for (int i = 0; i < 3; ++i)
    EXPECT_FALSE(box.contains(nan * Vector3d::Unit(i)));
  EXPECT_TRUE(std::isnan(box.distance({nan, 0, 0})));
}

TEST(Aabb, MeasuresOfABrickAreThoseComputedByHand) {
  const Aabb brick({1, 2, 3}, {3, 5, 7});
  EXPECT_EQ(brick.volume(), 24);
  EXPECT_EQ(brick.surface_area(), 52);
  EXPECT_EQ(brick.center(), Vector3d(2, 3.5, 5));
  EXPECT_EQ(brick.support({1, -1, 1}), Vector3d(3, 2, 7));
  EXPECT_EQ(brick.distance({6, 9, 7}), 5);
  EXPECT_EQ(brick.distance({2, 3, 4}), 0);
  EXPECT_EQ(brick.aabb(), brick);
}

TEST(Aabb, OverlapsWhereOnePointIsShared) {
  const Aabb box({0, 0, 0}, {1, 1, 1});
  EXPECT_TRUE(box.overlaps(box));
  EXPECT_TRUE(box.overlaps(Aabb({1, 1, 1}, {2, 2, 2}))) << "a corner";
  EXPECT_TRUE(Aabb({1, 1, 1}, {2, 2, 2}).overlaps(box));
  EXPECT_TRUE(box.overlaps(Aabb({-9, 0.5, 0.5}, {9, 0.5, 0.5}))) << "a line through it";
  for (int k = 0; k < 3; ++k) {
    const Vector3d beside = std::nextafter(1, 2) * Vector3d::Unit(k);
    EXPECT_FALSE(box.overlaps(Aabb(beside, beside + Vector3d::Ones()))) << k;
    EXPECT_FALSE(Aabb(beside, beside + Vector3d::Ones()).overlaps(box)) << k;
  }
  EXPECT_FALSE(box.overlaps(Aabb()));
  EXPECT_FALSE(Aabb().overlaps(box));
  EXPECT_FALSE(Aabb().overlaps(Aabb()));
}

TEST(Aabb, AFlatBoxHasAnAreaAndAPointHasNone) {
  EXPECT_EQ(Aabb({0, 0, 1}, {2, 3, 1}).surface_area(), 12);
  EXPECT_EQ(Aabb({0, 0, 1}, {2, 3, 1}).volume(), 0);
  const Aabb point = Aabb().extend({1, 2, 3});
  EXPECT_FALSE(point.empty());
  EXPECT_EQ(point.surface_area(), 0);
  EXPECT_EQ(point.distance({1, 2, 4}), 1);
}

TEST(Aabb, DistanceNeitherOverflowsNorVanishes) {
  EXPECT_DOUBLE_EQ(Aabb().extend(Vector3d::Zero()).distance({3e-200, 4e-200, 0}), 5e-200);
  EXPECT_DOUBLE_EQ(Aabb().extend(Vector3d::Zero()).distance({3e200, 4e200, 0}), 5e200);
  EXPECT_EQ(Aabb().extend(Vector3d::Zero()).distance({infinity, 0, 0}), infinity);
}

TEST(Aabb, CornersComeInTheirDocumentedOrder) {
  const auto corners = Aabb({0, 0, 0}, {1, 2, 4}).corners();
  for (unsigned i = 0; i < 8; ++i)
    EXPECT_EQ(corners[i], Vector3d(i & 1, i & 2, i & 4));
}

TEST(Aabb, MeshFacesLookOutward) {
  const Aabb box({1, 1, 1}, {2, 3, 4});
  const Mesh mesh = box.mesh();
  ASSERT_EQ(mesh.faces.size(), 6u);
  for (const auto& f : mesh.faces) {
    const Vector3d a = mesh.vertices[f[0]], b = mesh.vertices[f[1]], c = mesh.vertices[f[2]];
    EXPECT_GT((b - a).cross(c - b).dot(a - box.center()), 0);
  }
}

TEST(Aabb, MeshIsClosed) {
  expect_closed(Aabb({1, 1, 1}, {2, 3, 4}).mesh());
}

TEST(Aabb, MergeWithEmptyIsIdentity) {
  const Aabb box({0, 1, 2}, {3, 4, 5});
  EXPECT_EQ(Aabb(box).merge(Aabb()), box);
  EXPECT_EQ(Aabb().merge(box), box);
}

TEST(Aabb, MergeIsCommutativeAndAssociative) {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    const Aabb a = around(Aabb(), random.cloud({"", 0, 1}, Span::solid, 2));
    const Aabb b = around(Aabb(), random.cloud({"", 0, 1}, Span::line, 2));
    const Aabb c = around(Aabb(), random.cloud({"", 0, 1}, Span::point, 1));
    EXPECT_EQ(Aabb(a).merge(b), Aabb(b).merge(a));
    EXPECT_EQ(Aabb(a).merge(b).merge(c), Aabb(a).merge(Aabb(b).merge(c)));
  }
}

TEST(Aabb, ExtendIgnoresPointsThatAreNotFinite) {
  const Aabb box({0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(Aabb(box).extend({nan, 5, 5}), box);
  EXPECT_EQ(Aabb(box).extend({5, infinity, 5}), box);
}

TEST(Aabb, TransformedByTheIdentityIsUnchanged) {
  const Aabb box({0.1, 0.2, 0.3}, {5e6 + 0.1, 0.7, 1e20});
  EXPECT_EQ(box.transformed(Eigen::Isometry3d::Identity()), box);
}

TEST(Aabb, TransformedHoldsTheExactImageAndNoNextDoubleWould) {
  Random random(2);
  for (const Scale& scale : scales()) {
    SCOPED_TRACE(scale.name);
    for (int i = 0; i < 20; ++i) {
      const Aabb box = around(Aabb(), random.cloud(scale, Span::solid, 3));
      const Eigen::Isometry3d t = random.isometry(scale.extent);
      const Aabb moved = box.transformed(t);
      bool tight = false;
      for (const Vector3d& corner : box.corners()) {
        const ExactPoint p = image(t, exact(corner));
        EXPECT_TRUE(inside(moved, p));
        tight = tight || p[0] > Rational(std::nextafter(moved.max().x(), -infinity));
      }
      EXPECT_TRUE(tight || scale.extent < 1e-150) << "below, products fall under the smallest double";
    }
  }
}

TEST(Aabb, FloatCopyEnclosesAndNoNextFloatWould) {
  Random random(3);
  for (const Scale& scale : scales()) {
    SCOPED_TRACE(scale.name);
    for (int i = 0; i < 50; ++i) {
      const Aabb box = around(Aabb(), random.cloud(scale, Span::solid, 3));
      const FloatAabb f = box.cast_float();
      for (int k = 0; k < 3; ++k) {
        EXPECT_LE(f.min[k], box.min()[k]);
        EXPECT_GE(f.max[k], box.max()[k]);
        EXPECT_GT(std::nextafter(f.min[k], INFINITY), box.min()[k]);
        EXPECT_LT(std::nextafter(f.max[k], -INFINITY), box.max()[k]);
      }
    }
  }
  const FloatAabb exact_copy = Aabb({-1e-41f, 0, 1}, {1e-41f, 0, 1}).cast_float();
  EXPECT_EQ(exact_copy.min, Eigen::Vector3f(-1e-41f, 0, 1));
  EXPECT_EQ(exact_copy.max, Eigen::Vector3f(1e-41f, 0, 1));
}

#if defined(__SSE__)
TEST(Aabb, FloatCopyKeepsDenormalsWhereTheHostFlushesThem) {
  const unsigned saved = _mm_getcsr();
  _mm_setcsr(saved | 0x8040u);  // FTZ and DAZ
  const FloatAabb f = Aabb({-1e-41, 0, 1}, {1e-41, 0, 1}).cast_float();
  _mm_setcsr(saved);
  EXPECT_LE(f.min.x(), -1e-41);
  EXPECT_GE(f.max.x(), 1e-41);
  EXPECT_LT(f.max.x(), 1.001e-41);
}
#endif

}  // namespace
}  // namespace pcl_bv::detail
