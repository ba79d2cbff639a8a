// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The hull and what is found on the way to it.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <set>

#include "clouds.h"
#include "exact.h"
#include "executions.h"
#include "fits.h"
#include "hull/local_hull.h"
#include "hull/support_tree.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/numeric/float_environment.h"
#include "solids.h"

namespace pcl_bv::detail {
namespace {

using test::exact;
using test::is_closed;
using test::Rational;
using test::TestCloud;
using test::volume6;

// Extremal by definition: some plane through it has all others strictly on one side. By brute force: of every
// three points with all others on one side, exactly.
std::set<std::size_t> brute_force_vertices(const PointView& points) {
  std::vector<test::ExactPoint> all;
  for (std::size_t i = 0; i < points.count; ++i)
    all.push_back(exact(load_point(points, i)));
  std::set<std::size_t> vertices;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      for (std::size_t k = j + 1; k < all.size(); ++k) {
        bool above = false, below = false;
        for (std::size_t l = 0; l < all.size() && !(above && below); ++l) {
          const int sign = volume6(all[i], all[j], all[k], all[l]).sign();
          above = above || sign > 0;
          below = below || sign < 0;
        }
        if (!(above && below)) vertices.insert({i, j, k});
      }
    }
  }
  return vertices;
}

struct Found {
  LocalHull hull;
  Supports supports;
};

LocalHull hull_of(const PointView& points, const Execution& execution = {}) {
  const FloatEnvironment environment;
  const Supports supports = find_supports(points, DirectionSet::dop26, SupportDetail::points, execution);
  return local_hull(points, supports, LocalFrame(supports), execution);
}

Hull fit(const PointView& points, const Execution& execution = {}) {
  Hull hull = *fit_hull(points, execution);
  return hull;
}

TEST(LocalHull, HasTheVerticesOfBruteForce) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const TestCloud<float> cloud = test::gaussian<float>(24, seed);
    std::set<std::size_t> found;
    for (const HullPoint& v : hull_of(cloud.view()).vertices)
      found.insert(v.index);
    EXPECT_EQ(found, brute_force_vertices(cloud.view())) << "seed " << seed;
  }
}

// No point that is no candidate may be above a triangle of the closed surface. Returns the number of such
// points.
template <typename T>
std::size_t expect_points_inside(const TestCloud<T>& cloud) {
  SCOPED_TRACE(cloud.name);
  const FloatEnvironment environment;
  const PointView points = cloud.view();
  const Supports supports = find_supports(points, DirectionSet::dop26, SupportDetail::points, {});
  const LocalHull hull = hull_of(points);
  std::set<std::size_t> kept;
  for (const HullPoint& c : hull.candidates)
    kept.insert(c.index);
  const std::size_t inside = points.count - supports.dropped - kept.size();
  if (inside == 0) return 0;  // every point is a candidate: there may be no surface
  EXPECT_TRUE(is_closed(hull.triangles));
  for (std::size_t i = 0; i < points.count; ++i) {
    const Coordinates p = load_point(points, i);
    if (!is_valid(p) || kept.count(i) > 0) continue;
    for (const Triangle& t : hull.triangles) {
      const auto at = [&](std::int32_t c) { return exact(hull.vertices[static_cast<std::size_t>(c)].point); };
      EXPECT_LE(volume6(at(t[0]), at(t[1]), at(t[2]), exact(p)), 0) << "point " << i;
    }
  }
  return inside;
}

TEST(LocalHull, EveryFloatPointIsExactlyInIt) {
  std::size_t inside = 0;
  for (const TestCloud<float>& cloud : test::nasty_clouds<float>()) {
    if (cloud.size() > 100 && cloud.size() <= 1025) inside += expect_points_inside(cloud);
  }
  EXPECT_GT(inside, 1000U);
  EXPECT_GT(expect_points_inside(test::gaussian<float>(800, 8, 20, 5e6)), 600U);
  EXPECT_GT(expect_points_inside(test::gaussian<float>(800, 8, 1e-3, 1)), 600U);
}
TEST(LocalHull, EveryDoublePointIsExactlyInIt) {
  EXPECT_GT(expect_points_inside(test::gaussian<double>(800, 1)), 600U);
  EXPECT_GT(expect_points_inside(test::gaussian<double>(800, 8, 20, 5e6)), 600U);
  EXPECT_GT(expect_points_inside(test::gaussian<double>(800, 8, 1e-60, 0)), 600U);
}

// Four extreme points, and others outside of their tetrahedron that reach no farther along any direction.
TEST(LocalHull, WhatTheExtremePointsDoNotEncloseIsKept) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
    TestCloud<double> cloud = test::gaussian<double>(4, seed, 1, 20);
    Kdop kdop = *fit_kdop(cloud.view(), KdopSet::dop26());
    const Aabb box = kdop.aabb();
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    while (cloud.size() < 600) {
      const Eigen::Vector3d part(unit(random), unit(random), unit(random));
      const Eigen::Vector3d p = box.min() + part.cwiseProduct(box.max() - box.min());
      if (kdop.contains(p)) cloud.xyz.insert(cloud.xyz.end(), p.begin(), p.end());
    }
    EXPECT_EQ(verify(fit(cloud.view()), cloud.view()).outside, 0u) << "seed " << seed;
  }
}

TEST(LocalHull, MostPointsOfASolidAreDropped) {
  EXPECT_LT(hull_of(test::gaussian<float>(20'000, 1).view()).candidates.size(), 1000u);
  EXPECT_LT(hull_of(test::gaussian<double>(20'000, 1).view()).candidates.size(), 1000u);
}

// All of a 16 by 16 by 16 lattice, turned: thousands of points on its faces.
TEST(LocalHull, OfALatticeIsItsEightCorners) {
  TestCloud<float> cloud{"lattice", {}};
  for (int i = 0; i < 4096; ++i)
    cloud.xyz.insert(cloud.xyz.end(), {float(i % 16), float(i / 16 % 16), float(i / 256)});
  const Hull hull = fit(cloud.view());
  EXPECT_EQ(hull.vertices().size(), 8u);
  EXPECT_EQ(hull.planes().size(), 6u);
  EXPECT_EQ(hull.triangles().size(), 12u);
  EXPECT_DOUBLE_EQ(hull.volume(), 3375);
  EXPECT_DOUBLE_EQ(hull.surface_area(), 1350);
  EXPECT_TRUE(hull.center().isApprox(Eigen::Vector3d::Constant(7.5)));
}

TEST(LocalHull, OfCosphericalPointsHasAllOfThem) {
  TestCloud<float> cloud{"|p| = 9", {}};
  for (const auto& q : {std::array{1, 4, 8}, {4, 4, 7}, {3, 6, 6}, {0, 0, 9}}) {
    std::array<int, 3> p = q;
    std::sort(p.begin(), p.end());
    do {
      for (int signs = 0; signs < 8; ++signs) {
        for (std::size_t axis = 0; axis < 3; ++axis)
          cloud.xyz.push_back(static_cast<float>((signs >> axis & 1) != 0 ? -p[axis] : p[axis]));
      }
    } while (std::next_permutation(p.begin(), p.end()));
  }
  const Hull hull = fit(cloud.view());  // points with a 0 come twice and more
  EXPECT_EQ(hull.vertices().size(), 48u + 24u + 24u + 6u);
  EXPECT_EQ(verify(hull, cloud.view()).outside, 0u);
}

void expect_exact_maxima(const TestCloud<float>& cloud) {
  SCOPED_TRACE(cloud.name);
  const LocalHull hull = hull_of(cloud.view());
  for (const std::size_t queries : {1u, 1000u}) {
    const SupportTree tree(hull.candidates, queries);
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 50; ++i) {
      const Eigen::Vector3d n = Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
      Rational greatest = test::exact_dot(n, load_point(cloud.view(), 0));
      for (std::size_t k = 1; k < cloud.size(); ++k)
        greatest = std::max(greatest, test::exact_dot(n, load_point(cloud.view(), k)));
      EXPECT_EQ(tree.max_projection_up(n), test::least_double_above(greatest));
    }
  }
}

TEST(SupportTree, IsTheExactMaximum) {
  // The second has so many candidates that boxes have the sides of least rectangles.
  TestCloud<float> ball = test::gaussian<float>(1200, 6);
  for (std::size_t i = 0; i < ball.xyz.size(); i += 3)
    Eigen::Map<Eigen::Vector3f>(&ball.xyz[i]).normalize();
  for (const TestCloud<float>& cloud : {test::gaussian<float>(300, 5, 20, 5e6), ball})
    expect_exact_maxima(cloud);
}

TEST(Hull, FlatInputHasItsRankAndNoMessage) {
  const auto line = [](int i) { return Eigen::Vector3d(i, 2 * i, -3 * i); };
  const auto plane = [](int i) { return Eigen::Vector3d(i % 7, i / 7, i % 7 + i / 7); };
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  for (const int n : {1, 2, 3, 4, 49, 300}) {
    for (const int rank : {0, 1, 2}) {
      TestCloud<double> cloud{"flat", {}};
      for (int i = 0; i < n; ++i) {
        const Eigen::Vector3d p = rank == 0 ? Eigen::Vector3d(0.1, 0.2, 0.3) : rank == 1 ? line(i) : plane(i);
        cloud.xyz.insert(cloud.xyz.end(), p.begin(), p.end());
      }
      Hull hull;
      const EstimationResult result = test::take(fit_hull(cloud.view()), hull);
      const int spans = std::min({rank, n - 1, n < 8 ? 1 : 2});
      EXPECT_EQ(hull.rank(), spans) << n << " points";
      EXPECT_EQ(result.rank, spans);
      EXPECT_EQ(result.status, EstimationStatus::degenerate);
      EXPECT_TRUE(hull.triangles().empty());
      EXPECT_EQ(hull.vertices().size(), spans == 0 ? 1u : spans == 1 ? 2u : n == 300 ? 5u : 4u);
      EXPECT_EQ(verify(hull, cloud.view()).outside, 0u);
      EXPECT_EQ(hull.volume(), 0);
    }
  }
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Hull, ThinnerAndThinnerSolidsNeverFail) {
  for (int thin = 0; thin <= 60; ++thin) {
    TestCloud<double> cloud = test::gaussian<double>(500, 11);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      double* p = &cloud.xyz[3 * i];
      p[2] = p[0] + 2 * p[1] + std::ldexp(p[2], -thin);
    }
    Hull hull;
    const EstimationResult result = test::take(fit_hull(cloud.view()), hull);
    EXPECT_EQ(verify(hull, cloud.view()).outside, 0u) << "2^-" << thin;
    EXPECT_EQ(result.rank, thin < 34 ? 3 : thin > 38 ? 2 : result.rank) << "2^-" << thin;
  }
}

TEST(Hull, FacesAreClosedVerticesAreTheCloudsAndTheBoxIsExact) {
  for (const TestCloud<float>& cloud : test::nasty_clouds<float>()) {
    SCOPED_TRACE(cloud.name);
    Hull hull;
    const EstimationResult result = test::take(fit_hull(cloud.view()), hull);
    if (result.used == 0) continue;
    std::set<std::array<double, 3>> stored;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Coordinates p = load_point(cloud.view(), i);
      stored.insert({p.x + 0.0, p.y + 0.0, p.z + 0.0});
    }
    for (const Eigen::Vector3d& v : hull.vertices())
      EXPECT_EQ(stored.count({v.x(), v.y(), v.z()}), 1u);
    if (hull.rank() == 3) {
      EXPECT_TRUE(is_closed(hull.triangles()));
    }
    Aabb box = *fit_aabb(cloud.view());
    EXPECT_EQ(hull.aabb(), box);
  }
}

// Not a square's, whose edges turned by a right angle are edges again.
TEST(Hull, OfATriangleEndsAtItsEdges) {
  const TestCloud<double> cloud{"triangle", {0, 0, 0, 8, 0, 0, 0, 6, 0}};
  const Hull hull = fit(cloud.view());
  for (const auto& [x, y] : {std::pair{4.0, 3.0}, {4.0, 0.0}, {0.0, 3.0}}) {
    const Eigen::Vector3d edge(x, y, 0), inside(2, 2, 0);
    EXPECT_TRUE(hull.contains(edge + 0x1p-20 * (inside - edge))) << edge.transpose();
    EXPECT_FALSE(hull.contains(edge - 0x1p-20 * (inside - edge))) << edge.transpose();
  }
}

TEST(Hull, PlanesTouchTheirFaces) {
  const TestCloud<float> cloud = test::gaussian<float>(3000, 8, 20, 5e6);
  const Hull hull = fit(cloud.view());
  for (const HullPlane& plane : hull.planes()) {
    Rational greatest = test::exact_dot(plane.normal, load_point(cloud.view(), 0));
    for (const Eigen::Vector3d& v : hull.vertices())
      greatest = std::max(greatest, test::exact_dot(plane.normal, Coordinates{v.x(), v.y(), v.z()}));
    EXPECT_EQ(plane.offset, test::least_double_above(greatest));
    EXPECT_NEAR(plane.normal.norm(), 1, 1e-15);
  }
}

TEST(Hull, IsSmallerThanAnyOther) {
  const TestCloud<float> cloud = test::gaussian<float>(2000, 4);
  const double volume = fit(cloud.view()).volume();
  Kdop kdop = *fit_kdop(cloud.view(), KdopSet::dop26());
  EXPECT_LT(volume, kdop.volume());
}

}  // namespace
}  // namespace pcl_bv::detail
