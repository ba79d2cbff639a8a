// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Claims of the k-DOP slab by slab; those of its shape are in kdop_geometry_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "exact.h"
#include "kdop_sets.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/volumes/kdop.h"

namespace pcl_bv::detail {
namespace {

using namespace pcl_bv::testing;
using Eigen::Vector3d;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

SlabVector slabs(std::initializer_list<double> values) {
  SlabVector result(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), result.begin());
  return result;
}

TEST(Kdop, DefaultIsAnEmpty26Dop) {
  const Kdop kdop;
  EXPECT_TRUE(kdop.empty());
  EXPECT_EQ(kdop.size(), 13u);
  EXPECT_EQ(kdop.min(12), infinity);
  EXPECT_EQ(kdop.max(12), -infinity);
}

TEST(Kdop, EmptyHasNoExtentAndHoldsNothing) {
  const Kdop kdop(KdopSet::dop14());
  EXPECT_EQ(kdop.volume(), 0);
  EXPECT_EQ(kdop.surface_area(), 0);
  EXPECT_EQ(kdop.width(3), 0);
  EXPECT_FALSE(kdop.contains(Vector3d::Zero()));
  EXPECT_EQ(kdop.distance(Vector3d::Zero()), infinity);
  EXPECT_TRUE(kdop.center().hasNaN());
  EXPECT_TRUE(kdop.support(Vector3d::UnitX()).hasNaN());
  EXPECT_TRUE(kdop.corners().empty());
  EXPECT_TRUE(kdop.mesh().faces.empty());
  EXPECT_TRUE(kdop.aabb().empty());
  EXPECT_TRUE(kdop.transformed(Eigen::Isometry3d::Identity()).empty());
}

TEST(Kdop, RefusesWhatIsNoSlabs) {
  EXPECT_THROW(Kdop(nullptr), std::invalid_argument);
  EXPECT_THROW(Kdop(KdopSet::dop6(), slabs({0, 0}), slabs({1, 1, 1})), std::invalid_argument);
  EXPECT_THROW(Kdop(KdopSet::dop6(), slabs({0, 0, 0}), slabs({1, 1})), std::invalid_argument);
  EXPECT_THROW(Kdop(KdopSet::dop6(), slabs({0, nan, 0}), slabs({1, 1, 1})), std::invalid_argument);
  EXPECT_THROW(Kdop(KdopSet::dop6(), slabs({0, 0, -infinity}), slabs({1, 1, 1})), std::invalid_argument);
}

TEST(Kdop, AnyMinAboveItsMaxIsTheEmptyKdop) {
  EXPECT_EQ(Kdop(KdopSet::dop6(), slabs({0, 2, 0}), slabs({1, 1, 1})), Kdop(KdopSet::dop6()));
}

TEST(Kdop, StoresNoNegativeZero) {
  const Kdop kdop = Kdop().extend({-0.0, -0.0, -0.0});
  for (std::size_t i = 0; i < kdop.size(); ++i) {
    EXPECT_FALSE(std::signbit(kdop.min(i)) || std::signbit(kdop.max(i))) << i;
  }
  const Kdop stored(KdopSet::dop6(), slabs({-0.0, 0, -1}), slabs({1, 1, -0.0}));
  EXPECT_FALSE(std::signbit(stored.min(0)) || std::signbit(stored.max(2)));
}

TEST(Kdop, WidthIsThatOfAUnitDirection) {
  const Kdop kdop = Kdop().extend({0, 0, 0}).extend({1, 1, 1});
  EXPECT_EQ(kdop.width(0), 1);
  EXPECT_DOUBLE_EQ(kdop.width(3), std::sqrt(3));
  EXPECT_DOUBLE_EQ(kdop.width(7), std::sqrt(2));
  EXPECT_EQ(kdop.width(8), 0);
}

TEST(Kdop, ExtendTakesTheExactProjectionWhereItIsADouble) {
  const Kdop kdop = Kdop().extend({1e20, 1, 1e20});
  EXPECT_EQ(kdop.min(4), 1) << "(1, 1, -1): plain double says 0";
  EXPECT_EQ(kdop.max(4), 1);
}

TEST(Kdop, ExtendRoundsEachSlabToTheNextDoubleOutward) {
  Random random(21);
  for (const auto& set : kdop_sets()) {
    for (const Scale& scale : scales()) {
      SCOPED_TRACE(scale.name + ", " + std::to_string(set->size()));
      for (int i = 0; i < 20; ++i) {
        const Vector3d p = random.point(scale);
        const Kdop kdop = Kdop(set).extend(p);
        ASSERT_TRUE(inside(kdop, exact(p)));
        ASSERT_TRUE(kdop.contains(p));
        if (scale.extent < 1e-150) continue;  // where products lose their last bits a margin is added
        for (std::size_t k = 0; k < kdop.size(); ++k) {
          const Rational s = dot(set->direction(k), exact(p));
          EXPECT_TRUE(Rational(std::nextafter(kdop.min(k), infinity)) > s);
          EXPECT_TRUE(Rational(std::nextafter(kdop.max(k), -infinity)) < s);
        }
      }
    }
  }
}

TEST(Kdop, ExtendHoldsEveryPointByExactArithmetic) {
  Random random(22);
  for (const auto& set : kdop_sets()) {
    for (const Scale& scale : scales()) {
      for (const Span span : spans()) {
        SCOPED_TRACE(scale.name + ", span " + std::to_string(static_cast<int>(span)));
        const auto points = random.cloud(scale, span, 20);
        const Kdop kdop = around(Kdop(set), points);
        for (const Vector3d& p : points) {
          ASSERT_TRUE(inside(kdop, exact(p)));
          ASSERT_TRUE(kdop.contains(p));
          EXPECT_EQ(kdop.distance(p), 0);
        }
        EXPECT_EQ(around(kdop, points), kdop) << "all are inside: no change";
      }
    }
  }
}

TEST(Kdop, ExtendHoldsPointsWhoseOnlyProductLosesItsLastBits) {
  const auto set =
      std::make_shared<const KdopSet>(std::vector<Vector3d>{{0.1, 0, 0}, {0, 0.7, 0}, {0, 0, 1.0 / 3}});
  Random random(30);
  for (const double size : {1e-290, 1e-305, 1e-310, 1e-315, 1e-322}) {
    for (int i = 0; i < 100; ++i) {
      const Vector3d p = random.vector(size);
      ASSERT_TRUE(inside(Kdop(set).extend(p), exact(p))) << "seed 30, " << size << ", " << i;
    }
  }
}

TEST(Kdop, ExtendHoldsPointsThatPlainArithmeticPutsOnTheSurface) {
  Random random(29);
  for (int i = 0; i < 2000; ++i) {
    const Vector3d p = Vector3d(1, 1, 1) + random.vector(0.5);
    Vector3d q = p;  // at most some units in the last place away
    for (int axis = 0; axis < 3; ++axis)
      q[axis] += std::floor(random.uniform(-2, 3)) * 0x1p-53;
    const Kdop kdop = Kdop().extend(p).extend(q);
    ASSERT_TRUE(inside(kdop, exact(p)) && inside(kdop, exact(q)))
        << p.transpose() << " and " << q.transpose();
  }
}

TEST(Kdop, ContainsErrsOnlyTowardsTrueAtTheSurface) {
  // A point whose plain projection x + y + z is off by more than a unit in the last place of the result.
  Random random(23);
  int inexact = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3d p(random.uniform(1e6, 5e6), random.uniform(-1, 1), -random.uniform(1e6, 5e6));
    const Kdop kdop = Kdop(KdopSet::dop14()).extend(p);
    const double plain = (p.x() + p.y()) + p.z();
    inexact += plain < kdop.min(3) || plain > kdop.max(3);
    ASSERT_TRUE(kdop.contains(p)) << i;
  }
  EXPECT_GT(inexact, 100) << "the cases are too easy";
}

TEST(Kdop, DoesNotContainWhatIsOutside) {
  const Kdop kdop =
      Kdop(KdopSet::dop26()).extend({0, 0, 0}).extend({1, 0, 0}).extend({0, 1, 0}).extend({0, 0, 1});
  EXPECT_TRUE(kdop.contains({0.25, 0.25, 0.25}));
  EXPECT_FALSE(kdop.contains({0.5, 0.5, 0.5})) << "inside the box but beyond (1, 1, 1)";
  EXPECT_FALSE(kdop.contains({0.25, 0.25, 0.5 + 1e-14}));
  for (int i = 0; i < 3; ++i)
    EXPECT_FALSE(kdop.contains(nan * Vector3d::Unit(i)));
  EXPECT_FALSE(kdop.contains({infinity, 0, 0}));
}

TEST(Kdop, ExtendIgnoresPointsThatAreNotFinite) {
  const Kdop kdop = Kdop().extend({1, 2, 3});
  EXPECT_EQ(Kdop(kdop).extend({nan, 0, 0}), kdop);
  EXPECT_EQ(Kdop(kdop).extend({0, infinity, 0}), kdop);
}

TEST(Kdop, MergeIsCommutativeAssociativeAndHasAnIdentity) {
  Random random(24);
  for (int i = 0; i < 50; ++i) {
    SCOPED_TRACE(i);
    const auto cloud = random.cloud({"", 0, 1}, Span::solid, 6);
    const Kdop a = Kdop().extend(cloud[0]).extend(cloud[1]), b = Kdop().extend(cloud[2]).extend(cloud[3]),
               c = Kdop().extend(cloud[4]).extend(cloud[5]);
    EXPECT_EQ(Kdop(a).merge(b), Kdop(b).merge(a));
    EXPECT_EQ(Kdop(a).merge(b).merge(c), Kdop(a).merge(Kdop(b).merge(c)));
    EXPECT_EQ(Kdop(a).merge(b).merge(c), around(Kdop(), cloud));
    EXPECT_EQ(Kdop(a).merge(Kdop()), a);
    EXPECT_EQ(Kdop().merge(a), a);
  }
}

TEST(Kdop, MergeNeedsEqualSets) {
  EXPECT_THROW(Kdop(KdopSet::dop14()).merge(Kdop(KdopSet::dop26())), std::invalid_argument);
  const auto own = std::make_shared<const KdopSet>(*KdopSet::dop6());
  EXPECT_NO_THROW(Kdop(KdopSet::dop6()).merge(Kdop(own).extend({1, 2, 3})));
}

TEST(Kdop, OverlapsComparesSlabBySlab) {
  const Kdop octahedron =
      around(Kdop(KdopSet::dop14()), {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}});
  const auto at = [&](const Vector3d& p) { return Kdop(KdopSet::dop14()).extend(p); };
  EXPECT_TRUE(octahedron.overlaps(octahedron));
  for (const double side : {-1.0, 1.0}) {
    const Kdop on_face = at(side * Vector3d(0.5, 0.25, 0.25)),
               in_box = at(side * Vector3d(0.5, 0.25, 0.25 + 0x1p-52));
    EXPECT_TRUE(octahedron.overlaps(on_face) && on_face.overlaps(octahedron));
    EXPECT_FALSE(octahedron.overlaps(in_box) || in_box.overlaps(octahedron)) << "only their boxes do";
  }
  EXPECT_FALSE(octahedron.overlaps(Kdop(KdopSet::dop14())));
  EXPECT_FALSE(Kdop(KdopSet::dop14()).overlaps(octahedron));
  EXPECT_FALSE(Kdop().overlaps(Kdop()));
  EXPECT_THROW((void)octahedron.overlaps(Kdop(KdopSet::dop26())), std::invalid_argument);
}

TEST(Kdop, OverlapsWhereverAPointIsShared) {
  Random random(26);
  for (const auto& set : kdop_sets()) {
    for (const Scale& scale : scales()) {
      SCOPED_TRACE(scale.name + ", " + std::to_string(set->size()));
      auto a = random.cloud(scale, Span::solid, 4), b = random.cloud(scale, Span::line, 4);
      b.push_back(a[0]);
      EXPECT_TRUE(around(Kdop(set), a).overlaps(around(Kdop(set), b)));
      EXPECT_TRUE(around(Kdop(set), b).overlaps(around(Kdop(set), a)));
    }
  }
}

TEST(Kdop, FloatCopyEncloses) {
  Random random(25);
  for (const Scale& scale : scales()) {
    SCOPED_TRACE(scale.name);
    const Kdop kdop = around(Kdop(), random.cloud(scale, Span::solid, 5));
    const FloatKdop f = kdop.cast_float();
    EXPECT_EQ(f.set, kdop.set());
    for (int i = 0; i < 13; ++i) {
      EXPECT_LE(f.min[i], kdop.min()[i]);
      EXPECT_GE(f.max[i], kdop.max()[i]);
    }
  }
}

// Slabs of the definition, one by one.
void expect_slabs_of(const Kdop& kdop, const std::vector<Eigen::Vector3d>& points) {
  for (std::size_t i = 0; i < kdop.size(); ++i) {
    double low = kInfinity, high = -kInfinity;
    for (const Eigen::Vector3d& p : points) {
      low = std::min(low, p.dot(kdop.set()->direction(i)));
      high = std::max(high, p.dot(kdop.set()->direction(i)));
    }
    ASSERT_EQ(kdop.min(i), low) << i;
    ASSERT_EQ(kdop.max(i), high) << i;
    ASSERT_EQ(kdop.min()[static_cast<Eigen::Index>(i)], low) << i;
    ASSERT_EQ(kdop.max()[static_cast<Eigen::Index>(i)], high) << i;
  }
}

// Up to 13 slabs are stored inline, more are not. Small whole numbers: dot products are exact.
TEST(Kdop, OfAnyNumberOfSlabsIsAValue) {
  for (const int slabs : {3, 13, 14, 49}) {
    std::vector<Eigen::Vector3d> directions{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int i = 3; i < slabs; ++i)
      directions.emplace_back(1 + i % 5, i % 7 - 3, i / 7 - 2);
    const std::vector<Eigen::Vector3d> points{{1, 2, 3}, {-4, 5, 1}, {2, -6, 7}, {0, 9, -8}};
    Kdop first(std::make_shared<const KdopSet>(directions)), second = first;
    EXPECT_TRUE(first.empty());
    first.extend(points[0]).extend(points[1]);
    second.extend(points[2]).extend(points[3]);
    expect_slabs_of(first, {points[0], points[1]});
    Kdop all = first;
    EXPECT_EQ(all, first);
    all.merge(second);
    expect_slabs_of(all, points);
    expect_slabs_of(first, {points[0], points[1]});  // the copy is one
    EXPECT_NE(all, first);
    EXPECT_EQ(Kdop(all.set(), all.min(), all.max()), all);
    EXPECT_FALSE(first.overlaps(Kdop(first.set())));
    const Kdop moved = std::move(all);
    expect_slabs_of(moved, points);
    first = second;
    expect_slabs_of(first, {points[2], points[3]});
  }
}

}  // namespace
}  // namespace pcl_bv::detail
