// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Claims of the sphere.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "exact.h"
#include "pcl_bv/volumes/sphere.h"

namespace pcl_bv::detail {
namespace {

using namespace pcl_bv::testing;
using Eigen::Vector3d;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double pi = 3.14159265358979323846;

// The smallest double radius that holds the point by exact arithmetic.
double exact_radius(const Vector3d& center, const Vector3d& point) {
  return test::least_root_above(squared_distance(exact(center), exact(point)), (point - center).stableNorm());
}

TEST(Sphere, MeshHasVerticesOnTheSphereAndEdgesOfNearlyOneLength) {
  const Mesh mesh = Sphere({0, 0, 0}, 1).mesh();
  double shortest = infinity, longest = 0;
  for (const Vector3d& v : mesh.vertices)
    EXPECT_NEAR(v.norm(), 1, 1e-15);
  for (const auto& face : mesh.faces) {
    for (std::size_t i = 0; i < face.size(); ++i) {
      const Vector3d& from = mesh.vertices[static_cast<std::size_t>(face[i])];
      const Vector3d& to = mesh.vertices[static_cast<std::size_t>(face[(i + 1) % face.size()])];
      shortest = std::min(shortest, (to - from).norm());
      longest = std::max(longest, (to - from).norm());
    }
  }
  EXPECT_LT(longest, 1.2 * shortest);
}

TEST(Sphere, DefaultIsEmptyAndHoldsNothing) {
  const Sphere s;
  EXPECT_TRUE(s.empty());
  EXPECT_EQ(s.radius(), -1);
  EXPECT_TRUE(s.center().hasNaN());
  EXPECT_FALSE(s.contains(Vector3d::Zero()));
  EXPECT_EQ(s.volume(), 0);
  EXPECT_EQ(s.surface_area(), 0);
  EXPECT_EQ(s.distance(Vector3d::Zero()), infinity);
  EXPECT_TRUE(s.support(Vector3d::UnitX()).hasNaN());
  EXPECT_TRUE(s.aabb().empty());
  EXPECT_TRUE(s.mesh().vertices.empty());
  EXPECT_TRUE(s.transformed(Eigen::Isometry3d::Identity()).empty());
  EXPECT_EQ(s.cast_float().radius, -1);
  EXPECT_EQ(s, Sphere({1, 2, 3}, -5));
}

TEST(Sphere, RefusesNumbersThatAreNotFinite) {
  EXPECT_THROW(Sphere({nan, 0, 0}, 1), std::invalid_argument);
  EXPECT_THROW(Sphere({0, 0, 0}, nan), std::invalid_argument);
  EXPECT_THROW(Sphere({0, 0, 0}, infinity), std::invalid_argument);
}

TEST(Sphere, StoresNoNegativeZero) {
  const Sphere s({-0.0, 0, 0}, -0.0);
  EXPECT_FALSE(s.empty());
  EXPECT_FALSE(std::signbit(s.center().x()) || std::signbit(s.radius()));
}

TEST(Sphere, MeasuresAreThoseOfTheFormulas) {
  const Sphere s({1, 2, 3}, 2);
  EXPECT_DOUBLE_EQ(s.volume(), 32 * pi / 3);
  EXPECT_DOUBLE_EQ(s.surface_area(), 16 * pi);
  EXPECT_EQ(s.support({0, 0, 9}), Vector3d(1, 2, 5));
  EXPECT_EQ(s.support({0, 0, 0}), s.center());
  EXPECT_EQ(s.distance({1, 2, 10}), 5);
  EXPECT_EQ(s.distance({1, 2, 4}), 0);
  EXPECT_TRUE(std::isnan(s.distance({nan, 0, 0})));
  EXPECT_EQ(s.aabb(), Aabb({-1, 0, 1}, {3, 4, 5}));
}

TEST(Sphere, ContainsPointsExactlyOnItAtEverySize) {
  Random random(11);
  for (const Scale& scale : scales()) {
    SCOPED_TRACE(scale.name);
    for (int i = 0; i < 300; ++i) {
      const Vector3d center = random.point(scale), p = random.point(scale);
      const double r = exact_radius(center, p);
      ASSERT_TRUE(Sphere(center, r).contains(p)) << i;
      EXPECT_FALSE(scale.extent > 1e-150 && Sphere(center, r * (1 - 1e-14)).contains(p)) << i;
    }
  }
  const double tiny = std::sqrt(std::numeric_limits<double>::denorm_min());
  EXPECT_TRUE(Sphere({0, 0, 0}, 1.4 * tiny).contains({0.8 * tiny, 0.8 * tiny, 0.8 * tiny}))
      << "squares vanish";
  EXPECT_TRUE(Sphere({5e6, 5e6, 5e6}, 3).contains({5e6 + 1, 5e6 - 2, 5e6 + 2}));
}

TEST(Sphere, ContainsAsMuchMoreAsItSaysAndNoMore) {
  const Sphere unit({0, 0, 0}, 1);
  const double farthest = 1 + 0x1p-50;  // its square, rounded, is 1 + 16 2^-53
  EXPECT_TRUE(unit.contains({farthest, 0, 0}));
  EXPECT_FALSE(unit.contains({std::nextafter(farthest, 2), 0, 0}));
}

TEST(Sphere, ContainsNoNaN) {
  for (int i = 0; i < 3; ++i)
    EXPECT_FALSE(Sphere(Vector3d::Zero(), 1).contains(nan * Vector3d::Unit(i)));
}

TEST(Sphere, OverlapsErrsOnlyTowardsTrueAtTheSurface) {
  Random random(17);
  int inexact = 0;
  for (const Scale& scale : scales()) {
    SCOPED_TRACE(scale.name);
    for (int i = 0; i < 300; ++i) {
      const Vector3d a = random.point(scale), b = random.point(scale);
      const double r = random.uniform(0, 0.1) * scale.extent, reach = exact_radius(a, b);
      double s = std::max(0.0, reach - r);  // the least with s + r >= reach
      while (Rational(s) + Rational(r) < Rational(reach))
        s = std::nextafter(s, infinity);
      inexact += !((a - b).norm() <= r + s);
      ASSERT_TRUE(Sphere(a, r).overlaps(Sphere(b, s))) << i;
      ASSERT_TRUE(Sphere(b, s).overlaps(Sphere(a, r))) << i;
      if (scale.extent < 1e-150) continue;
      EXPECT_FALSE(Sphere(a, r).overlaps(Sphere(b, s - 1e-14 * (r + s)))) << i;
    }
  }
  EXPECT_GT(inexact, 0) << "the cases are too easy";
  const Sphere s({1, 2, 3}, 3);
  EXPECT_TRUE(s.overlaps(s));
  EXPECT_FALSE(s.overlaps(Sphere()) || Sphere().overlaps(s) || Sphere().overlaps(Sphere()));
}

TEST(Sphere, MergeWithEmptyIsIdentity) {
  const Sphere s({0.1, 0.2, 0.3}, 0.7);
  EXPECT_EQ(Sphere(s).merge(Sphere()), s);
  EXPECT_EQ(Sphere().merge(s), s);
  EXPECT_TRUE(Sphere().merge(Sphere()).empty());
}

TEST(Sphere, MergeHoldsBothByExactArithmeticAndIsCommutative) {
  Random random(12);
  for (const Scale& scale : scales()) {
    SCOPED_TRACE(scale.name);
    for (int i = 0; i < 300; ++i) {
      const Sphere a(random.point(scale), random.uniform(0, scale.extent));
      const Sphere b(random.point(scale), i % 3 == 0 ? a.radius() : random.uniform(0, scale.extent));
      const Sphere merged = Sphere(a).merge(b);
      ASSERT_TRUE(encloses(merged, a)) << i;
      ASSERT_TRUE(encloses(merged, b)) << i;
      EXPECT_EQ(merged, Sphere(b).merge(a)) << i;
      const double optimum = std::max(
          {((a.center() - b.center()).stableNorm() + a.radius() + b.radius()) / 2, a.radius(), b.radius()});
      EXPECT_LE(merged.radius(), optimum * (1 + 1e-14) + 4e-16 * scale.offset) << i;
    }
  }
}

TEST(Sphere, MergeWithAnEnclosedSphereReturnsTheBiggerUnchanged) {
  const Sphere big({0, 0, 0}, 3);
  EXPECT_EQ(Sphere(big).merge(Sphere({0.5, 0, 0}, 1)), big);
  EXPECT_EQ(Sphere({0.5, 0, 0}, 1).merge(big), big);
  EXPECT_EQ(Sphere(big).merge(Sphere({2, 0, 0}, 1)), big) << "touching from inside";
  EXPECT_EQ(Sphere(big).merge(big), big);
  const Sphere next = Sphere(big).merge(Sphere({std::nextafter(2, 3), 0, 0}, 1));
  EXPECT_NE(next, big) << "one unit in the last place too far";
  EXPECT_TRUE(encloses(next, Sphere({std::nextafter(2, 3), 0, 0}, 1)));
}

// The squares of the smallest sizes underflow.
TEST(Sphere, MergeWithAnEnclosedSphereReturnsTheBiggerAtAllSizes) {
  for (int exponent = -1000; exponent <= 300; exponent += 4) {
    const double unit = std::ldexp(1.0, exponent);
    const Sphere big(unit * Vector3d(1, 2, 3), 5 * unit);
    const auto merged = [&](double away) {
      return Sphere(big).merge(Sphere(unit * Vector3d(1 + away, 2, 3), 2 * unit));
    };
    EXPECT_EQ(merged(3), big) << "it touches from inside, " << exponent;
    EXPECT_EQ(merged(3 - 0x1p-10), big) << exponent;
    EXPECT_GT(merged(3 + 0x1p-10).radius(), big.radius()) << exponent;
  }
}

TEST(Sphere, MergeWithASphereThatReachesTheSurfaceButForRoundingChangesNothing) {
  // The bigger radius is the least double with which it holds the smaller sphere.
  Random random(15);
  for (int i = 0; i < 500; ++i) {
    const Sphere small(random.vector(1), std::ldexp(std::floor(random.uniform(0, 1 << 20)), -20));
    const Vector3d center = random.vector(1);
    double radius = (small.center() - center).norm() + small.radius();
    while (!encloses(Sphere(center, radius), small))
      radius = std::nextafter(radius, infinity);
    while (encloses(Sphere(center, std::nextafter(radius, 0)), small))
      radius = std::nextafter(radius, 0);
    const Sphere big(center, radius);
    ASSERT_EQ(Sphere(big).merge(small), big) << "seed 15, " << i;
    ASSERT_EQ(Sphere(small).merge(big), big) << "seed 15, " << i;
  }
}

TEST(Sphere, ExtendHoldsEveryPointByExactArithmetic) {
  Random random(13);
  for (const Scale& scale : scales()) {
    for (const Span span : spans()) {
      SCOPED_TRACE(scale.name + ", span " + std::to_string(static_cast<int>(span)));
      const auto points = random.cloud(scale, span, 100);
      const Sphere s = around(Sphere(), points);
      for (const Vector3d& p : points) {
        ASSERT_TRUE(inside(s, exact(p)));
        ASSERT_TRUE(s.contains(p));
        EXPECT_EQ(s.distance(p), 0);
      }
      EXPECT_EQ(around(s, points), s) << "all are inside: no change";
    }
  }
}

TEST(Sphere, ExtendByAPointExactlyOnTheSphereChangesNothing) {
  const Sphere s({1, 2, 3}, 3);
  EXPECT_EQ(Sphere(s).extend({2, 4, 5}), s);
  EXPECT_EQ(Sphere(s).extend({0, 0, 1}), s);
  const double beyond = std::nextafter(6, 7);
  EXPECT_GT(Sphere(s).extend({1, 2, beyond}).radius(), 3);
}

TEST(Sphere, ExtendIgnoresPointsThatAreNotFinite) {
  const Sphere s({1, 2, 3}, 3);
  EXPECT_EQ(Sphere(s).extend({nan, 0, 0}), s);
  EXPECT_EQ(Sphere(s).extend({0, -infinity, 0}), s);
  EXPECT_TRUE(Sphere().extend({0, 0, nan}).empty());
}

TEST(Sphere, OnePointHasRadiusZeroHoweverOftenItComes) {
  for (const Vector3d& p : {Vector3d(0.1, 0.2, 0.3), Vector3d(0, 0, 0), Vector3d(1e-320, -1e300, 0)}) {
    const Sphere s = Sphere().extend(p);
    EXPECT_EQ(s, Sphere(p, 0));
    EXPECT_TRUE(s.contains(p));
    EXPECT_EQ(Sphere(s).extend(p), s);
  }
}

TEST(Sphere, TransformedHoldsTheExactImage) {
  Random random(14);
  for (const Scale& scale : scales()) {
    SCOPED_TRACE(scale.name);
    for (int i = 0; i < 100; ++i) {
      const Vector3d center = random.point(scale), p = random.point(scale);
      const Sphere s(center, exact_radius(center, p));
      const Eigen::Isometry3d t = random.isometry(scale.extent);
      const Sphere moved = s.transformed(t);
      EXPECT_TRUE(inside(moved, image(t, exact(p)))) << i;
      EXPECT_LE(moved.radius(), s.radius() * (1 + 4e-15) + 4e-15 * scale.offset + 1e-307) << i;
    }
  }
}

TEST(Sphere, TransformedByTheIdentityOrAQuarterTurnKeepsTheRadius) {
  const Sphere s({0.1, 5e6, 0.3}, 0.7);
  EXPECT_EQ(s.transformed(Eigen::Isometry3d::Identity()), s);
  Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
  turn.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  EXPECT_EQ(s.transformed(turn), Sphere({-5e6, 0.1, 0.3}, 0.7));
}

TEST(Sphere, TransformedByAMatrixThatStretchesStillEncloses) {
  Eigen::Isometry3d t = Eigen::Isometry3d::Identity();
  t.linear()(0, 1) = 1e-9;
  const Sphere moved = Sphere({0, 0, 0}, 5).transformed(t);
  EXPECT_TRUE(inside(moved, image(t, exact({3, 4, 0}))));
}

TEST(Sphere, AabbHoldsTheSphereAndNoNextDoubleWould) {
  Random random(15);
  for (const Scale& scale : scales()) {
    SCOPED_TRACE(scale.name);
    const Sphere s(random.point(scale), random.uniform(0, scale.extent));
    const Aabb box = s.aabb();
    for (int k = 0; k < 3; ++k) {
      const Rational low = Rational(s.center()[k]) - Rational(s.radius());
      const Rational high = Rational(s.center()[k]) + Rational(s.radius());
      EXPECT_TRUE(Rational(box.min()[k]) <= low && low < Rational(std::nextafter(box.min()[k], infinity)));
      EXPECT_TRUE(Rational(box.max()[k]) >= high && high > Rational(std::nextafter(box.max()[k], -infinity)));
    }
  }
}

TEST(Sphere, FloatCopyEnclosesTheSphere) {
  Random random(16);
  for (const Scale& scale : scales()) {
    SCOPED_TRACE(scale.name);
    for (int i = 0; i < 50; ++i) {
      const Sphere s(random.point(scale), random.uniform(0, scale.extent));
      const FloatSphere f = s.cast_float();
      if (std::isinf(f.radius)) {
        EXPECT_GT(scale.extent, 1e38);
        continue;
      }
      EXPECT_TRUE(encloses(Sphere(f.center.cast<double>(), f.radius), s)) << i;
    }
  }
}

TEST(Sphere, MeshIsClosedAndLiesOnTheSphere) {
  const Sphere s({1, 2, 3}, 2);
  const Mesh mesh = s.mesh();
  EXPECT_EQ(mesh.vertices.size(), 162u);
  EXPECT_EQ(mesh.faces.size(), 320u);
  double volume = 0;
  for (const auto& f : mesh.faces) {
    const Vector3d a = mesh.vertices[f[0]] - s.center(), b = mesh.vertices[f[1]] - s.center(),
                   c = mesh.vertices[f[2]] - s.center();
    EXPECT_GT(a.dot(b.cross(c)), 0) << "looks inward";
    volume += a.dot(b.cross(c)) / 6;
  }
  for (const Vector3d& v : mesh.vertices)
    EXPECT_NEAR((v - s.center()).norm(), 2, 1e-14);
  EXPECT_NEAR(volume, s.volume(), 0.05 * s.volume());
}

}  // namespace
}  // namespace pcl_bv::detail
