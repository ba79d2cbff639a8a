// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Claims of tightened() against the corners in rational numbers: all triples of planes, by brute force.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "exact.h"
#include "kdop_sets.h"
#include "pcl_bv/volumes/kdop.h"

namespace pcl_bv::detail {
namespace {

using namespace pcl_bv::testing;
using Eigen::Vector3d;

ExactPoint cross(const ExactPoint& a, const ExactPoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// The corners that the planes of slabs i, j, k give, in the polytope or not.
void add_corners(const Kdop& kdop, const std::array<std::size_t, 3>& slabs,
                 std::vector<ExactPoint>& corners) {
  const KdopSet& set = *kdop.set();
  std::array<ExactPoint, 3> dual;
  for (std::size_t m = 0; m < 3; ++m) {
    dual[m] = cross(exact(set.direction(slabs[(m + 1) % 3])), exact(set.direction(slabs[(m + 2) % 3])));
  }
  const Rational determinant = dot(set.direction(slabs[0]), dual[0]);
  if (determinant == 0) return;
  for (unsigned sides = 0; sides < 8; ++sides) {
    ExactPoint p{0, 0, 0};
    for (std::size_t m = 0; m < 3; ++m) {
      const Rational offset(sides >> m & 1 ? kdop.max(slabs[m]) : kdop.min(slabs[m]));
      for (std::size_t k = 0; k < 3; ++k)
        p[k] += offset * dual[m][k] / determinant;
    }
    if (inside(kdop, p)) corners.push_back(p);
  }
}

// None if the slabs have no common point.
std::vector<ExactPoint> exact_corners(const Kdop& kdop) {
  std::vector<ExactPoint> corners;
  for (std::size_t i = 0; i < kdop.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      for (std::size_t k = 0; k < j; ++k)
        add_corners(kdop, {i, j, k}, corners);
    }
  }
  return corners;
}

// Each slab moved out by as much as `margin` in space.
Kdop widened(const Kdop& kdop, double margin) {
  SlabVector by(kdop.min().size());
  for (std::size_t i = 0; i < kdop.size(); ++i)
    by[static_cast<Eigen::Index>(i)] = margin * kdop.set()->direction(i).norm();
  return {kdop.set(), kdop.min() - by, kdop.max() + by};
}

// What is promised.
double margin(const Kdop& kdop) {
  const Aabb box = kdop.aabb();
  const double extent = (box.max() - box.min()).lpNorm<Eigen::Infinity>();
  const double coordinates = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff();
  return 1e-13 * extent + 0x1p-48 * coordinates + 1e-300;
}

void expect_tightened(const Kdop& loose) {
  const Kdop tight = loose.tightened();
  const auto corners = exact_corners(loose);
  if (corners.empty()) {
    ASSERT_TRUE(tight.empty() || !exact_corners(widened(loose, margin(loose))).empty());
    return;
  }
  ASSERT_FALSE(tight.empty());
  const Kdop again = tight.tightened();
  for (std::size_t i = 0; i < loose.size(); ++i) {
    const Vector3d& n = loose.set()->direction(i);
    const auto [low, high] = std::minmax_element(
        corners.begin(), corners.end(), [&](const auto& a, const auto& b) { return dot(n, a) < dot(n, b); });
    ASSERT_LE(loose.min(i), tight.min(i));
    ASSERT_LE(tight.max(i), loose.max(i));
    ASSERT_TRUE(Rational(tight.min(i)) <= dot(n, *low)) << i;
    ASSERT_TRUE(Rational(tight.max(i)) >= dot(n, *high)) << i;
    const double slack = margin(loose) * n.norm();
    EXPECT_TRUE(dot(n, *low) <= Rational(tight.min(i)) + Rational(slack)) << i;
    EXPECT_TRUE(dot(n, *high) >= Rational(tight.max(i)) - Rational(slack)) << i;
    ASSERT_LE(tight.min(i), again.min(i));
    ASSERT_LE(again.max(i), tight.max(i));
    EXPECT_TRUE(Rational(again.min(i)) <= dot(n, *low)) << i << ", the second time";
    EXPECT_TRUE(Rational(again.max(i)) >= dot(n, *high)) << i << ", the second time";
  }
}

// Some slabs moved out by up to twice their width.
Kdop loosened(const Kdop& kdop, const Scale& scale, Random& random) {
  SlabVector min = kdop.min(), max = kdop.max();
  for (Eigen::Index i = 0; i < min.size(); ++i) {
    const double reach = scale.extent * kdop.set()->direction(static_cast<std::size_t>(i)).norm();
    if (random.uniform(0, 1) < 0.5) min[i] -= random.uniform(0, 2) * reach;
    if (random.uniform(0, 1) < 0.5) max[i] += random.uniform(0, 2) * reach;
  }
  return {kdop.set(), min, max};
}

TEST(KdopTightened, SlabsReachTheExactCornersAndNoneIsLost) {
  Random random(61);
  for (const auto& set : kdop_sets()) {
    for (const Scale& scale : scales()) {
      for (const Span span : spans()) {
        SCOPED_TRACE(scale.name + ", " + std::to_string(set->size()));
        const Kdop measured = around(Kdop(set), random.cloud(scale, span, 6));
        expect_tightened(loosened(measured, scale, random));
      }
    }
  }
}

TEST(KdopTightened, SlabsOfRandomSetsReachTheExactCorners) {
  Random random(62);
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    std::vector<Vector3d> directions;
    for (int k = 0; k < 3 + i % 6; ++k)
      directions.push_back(random.vector(1) * std::pow(10, random.uniform(-3, 3)));
    const auto set = std::make_shared<const KdopSet>(directions);
    const Scale scale = scales()[static_cast<std::size_t>(i % 2)];
    expect_tightened(loosened(around(Kdop(set), random.cloud(scale, Span::solid, 6)), scale, random));
  }
}

TEST(KdopTightened, MergedAndTransformedSlabsReachTheExactCorners) {
  Random random(63);
  for (const auto& set : kdop_sets()) {
    for (const Scale& scale : {scales()[0], scales()[1], scales()[5]}) {
      SCOPED_TRACE(scale.name + ", " + std::to_string(set->size()));
      const Kdop a = around(Kdop(set), random.cloud(scale, Span::solid, 6));
      const Kdop b = around(Kdop(set), random.cloud(scale, Span::line, 6));
      expect_tightened(Kdop(a).merge(b));
      expect_tightened(a.transformed(random.isometry(scale.extent)));
    }
  }
}

TEST(KdopTightened, RandomSlabsBecomeEmptyExactlyIfTheyHaveNoCommonPoint) {
  Random random(64);
  int empty = 0, sound = 0;
  for (const auto& set : kdop_sets()) {
    for (int i = 0; i < 30; ++i) {
      SCOPED_TRACE(std::to_string(set->size()) + ", " + std::to_string(i));
      SlabVector min(static_cast<Eigen::Index>(set->size())), max = min;
      for (std::size_t k = 0; k < set->size(); ++k) {
        const double middle = random.uniform(-1, 1), half = random.uniform(0, 2),
                     n = set->direction(k).norm();
        min[static_cast<Eigen::Index>(k)] = n * (middle - half);
        max[static_cast<Eigen::Index>(k)] = n * (middle + half);
      }
      const Kdop kdop(set, min, max);
      expect_tightened(kdop);
      ++(kdop.tightened().empty() ? empty : sound);
    }
  }
  EXPECT_GT(empty, 30);
  EXPECT_GT(sound, 30);
}

TEST(KdopTightened, KeepsTheVolumeAndLeavesMeasuredSlabsWhereTheyAre) {
  Random random(65);
  for (const auto& set : kdop_sets()) {
    for (const Scale& scale : scales()) {
      for (const Span span : spans()) {
        SCOPED_TRACE(scale.name + ", " + std::to_string(set->size()));
        const auto points = random.cloud(scale, span, 10);
        const Kdop measured = around(Kdop(set), points);
        const Kdop tight = measured.tightened();
        for (const Vector3d& p : points)
          ASSERT_TRUE(inside(tight, exact(p)));
        for (std::size_t i = 0; i < set->size(); ++i) {
          const double slack = margin(measured) * set->direction(i).norm();
          EXPECT_LE(tight.min(i), measured.min(i) + slack);
          EXPECT_GE(tight.max(i), measured.max(i) - slack);
        }
        const Kdop loose = loosened(measured, scale, random);
        if (span != Span::solid || scale.offset > 0 || scale.extent > 1e90) continue;
        EXPECT_NEAR(loose.tightened().volume(), loose.volume(), 1e-12 * loose.aabb().volume() + 1e-300);
      }
    }
  }
}

TEST(KdopTightened, SlabsBeyondTheCornersMoveToThem) {
  SlabVector reach(13);
  reach << 1, 1, 1, 9, 9, 9, 9, 5, 5, 5, 5, 5, 5;
  SlabVector expected(13);
  expected << 1, 1, 1, 3, 3, 3, 3, 2, 2, 2, 2, 2, 2;
  const Kdop kdop(KdopSet::dop26(), -reach, reach);
  EXPECT_EQ(kdop.tightened(), Kdop(KdopSet::dop26(), -expected, expected));
  EXPECT_EQ(kdop.tightened().tightened(), kdop.tightened());
}

TEST(KdopTightened, EmptyStaysEmpty) {
  EXPECT_EQ(Kdop(KdopSet::dop14()).tightened(), Kdop(KdopSet::dop14()));
}

TEST(KdopTightened, SlabsThatJustMeetLoseNoPointAndThoseThatJustMissAreEmpty) {
  const auto cut = [](double far) {  // the unit cube and x + y + z >= far
    SlabVector min(7), max(7);
    min << 0, 0, 0, far, -9, -9, -9;
    max << 1, 1, 1, 9, 9, 9, 9;
    return Kdop(KdopSet::dop14(), min, max).tightened();
  };
  EXPECT_EQ(cut(3), Kdop(KdopSet::dop14()).extend({1, 1, 1}));
  EXPECT_TRUE(cut(std::nextafter(3, 4)).empty());
}

}  // namespace
}  // namespace pcl_bv::detail
