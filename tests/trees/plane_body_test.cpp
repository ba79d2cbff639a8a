// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// How far bodies of planes reach, against all their vertices.

#include "plane_body.h"

#include <gtest/gtest.h>

#include <numeric>

#include "pcl_bv/numeric/vector3.h"
#include "scattered_volumes.h"

namespace pcl_bv {
namespace {

using namespace testing;
using Real = long double;
using RealVector = Eigen::Matrix<Real, 3, 1>;

// Planes about a ball, four of them the sides of a tetrahedron, with normals of many lengths.
std::vector<HullPlane> planes_about(Random& random, const Vector3d& center, double size, int count) {
  std::vector<HullPlane> planes;
  for (int i = 0; i < count; ++i) {
    Vector3d normal = random.vector(1).normalized();
    if (i < 4) normal = Vector3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i == 1 || i == 2 ? -1 : 1).normalized();
    normal *= std::exp(random.uniform(-18, 18));
    planes.push_back({normal, dot3(normal, center) + norm3(normal) * size * random.uniform(0.3, 1)});
  }
  return planes;
}

// As seen from the centre: where three planes meet and no other leaves it out.
std::vector<RealVector> vertices_of(const std::vector<HullPlane>& planes, const Vector3d& center,
                                    double size) {
  std::vector<RealVector> normals, vertices;
  std::vector<Real> offsets;
  for (const HullPlane& plane : planes) {
    const RealVector n = plane.normal.cast<Real>();
    normals.push_back(n / n.norm());
    offsets.push_back((plane.offset - n.dot(center.cast<Real>())) / n.norm());
  }
  for (std::size_t i = 0; i < planes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      for (std::size_t k = 0; k < j; ++k) {
        const Real det = normals[i].dot(normals[j].cross(normals[k]));
        if (std::abs(det) < 1e-6L) continue;
        const RealVector v =
            (offsets[i] * normals[j].cross(normals[k]) + offsets[j] * normals[k].cross(normals[i]) +
             offsets[k] * normals[i].cross(normals[j])) /
            det;
        bool in_all = true;
        for (std::size_t m = 0; m < planes.size(); ++m)
          in_all = in_all && normals[m].dot(v) <= offsets[m] + 1e-9L * size;
        if (in_all) vertices.push_back(v);
      }
    }
  }
  return vertices;
}

// Just inside the corners: from a thousandth of the size to some units in the last place.
std::vector<Vector3d> points_within(Random& random, const Hull& hull, const std::vector<Vector3d>& corners) {
  std::vector<Vector3d> found;
  const Vector3d center = std::accumulate(corners.begin(), corners.end(), Vector3d(0, 0, 0)) /
                          static_cast<double>(corners.size());
  for (const Vector3d& corner : corners) {
    const Vector3d p = corner + std::exp2(random.uniform(-50, -10)) * (center - corner);
    if (inside(hull, exact(p))) found.push_back(p);
  }
  return found;
}

TEST(PlaneBody, ReachesAsFarAsItsFarthestVertex) {
  Random random(61);
  std::size_t judged = 0;
  for (const Scale& scale :
       {Scale{"unit", 0, 1}, Scale{"1 mm", 0, 1e-3}, Scale{"1e6", 0, 1e6}, scales()[1], scales()[2]}) {
    for (int round = 0; round < 40; ++round) {
      const Vector3d center = random.point(scale);
      const std::vector<HullPlane> planes = planes_about(random, center, scale.extent, 4 + round % 12);
      const std::vector<RealVector> vertices = vertices_of(planes, center, scale.extent);
      std::vector<Vector3d> corners;
      for (const RealVector& v : vertices)
        corners.push_back(center + v.cast<double>());
      ASSERT_GE(corners.size(), 4U) << scale.name;
      const Hull hull(corners, {}, planes, 3);
      const PlaneBody body(hull);
      const std::vector<Vector3d> within = points_within(random, hull, corners);
      ASSERT_TRUE(body.box()) << scale.name;
      const Aabb about = around(Aabb(), corners);
      const double room = 1e-9 * scale.extent + 1e-12 * scale.offset;
      EXPECT_LT((body.box()->max() - about.max()).cwiseAbs().maxCoeff(), room) << scale.name;
      EXPECT_LT((body.box()->min() - about.min()).cwiseAbs().maxCoeff(), room) << scale.name;
      for (int i = 0; i < 20; ++i) {
        const Vector3d d = random.vector(1) * std::exp(random.uniform(-30, 30));
        Real farthest = -std::numeric_limits<Real>::infinity();
        for (const RealVector& v : vertices)
          farthest = std::max(farthest, d.cast<Real>().dot(v + center.cast<Real>()));
        const double reach = body.support_bound_up(d);
        EXPECT_NEAR(reach, static_cast<double>(farthest), taxicab3(d) * room) << scale.name;
        for (const Vector3d& p : within)
          EXPECT_LE(dot(d, exact(p)), Rational(reach)) << scale.name;
      }
      judged += within.size();
      for (const Vector3d& p : within)
        EXPECT_TRUE(body.box()->contains(p)) << scale.name;
    }
  }
  EXPECT_GT(judged, 1000U);
}

// Each weight is 1, so the doubt is 2^-46 of the greatest coordinate.
TEST(PlaneBody, AddsToEachSideWhatContainsMayAllow) {
  const Hull hull = cube({-1, -2, -3}, 4);
  const PlaneBody body(hull);
  ASSERT_TRUE(body.box());
  for (int k = 0; k < 3; ++k) {
    const double allowed = 2 * 0x1p-46 * 3;  // of twice the size, which bounds the size itself
    EXPECT_NEAR(body.box()->max()[k] - hull.aabb().max()[k], allowed, 0x1p-50);
    EXPECT_NEAR(hull.aabb().min()[k] - body.box()->min()[k], allowed, 0x1p-50);
    EXPECT_NEAR(body.support_bound_up(Vector3d::Unit(k)) - hull.aabb().max()[k], 0x1p-46 * 3, 0x1p-50);
    EXPECT_NEAR(body.support_bound_up(-Vector3d::Unit(k)) + hull.aabb().min()[k], 0x1p-46 * 3, 0x1p-50);
  }
  const PlaneBody other(cube({-1, -1, -1}, 4));
  EXPECT_NEAR(other.support_bound_up({1, 0, 0}) - 3, 0x1p-46 * 3, 0x1p-50);
}

Hull box_of(const Vector3d& low, const Vector3d& size, const std::vector<HullPlane>& more = {}) {
  std::vector<HullPlane> planes = more;
  for (int k = 0; k < 3; ++k) {
    planes.push_back({Vector3d::Unit(k), low[k] + size[k]});
    planes.push_back({-Vector3d::Unit(k), -low[k]});
  }
  return {{low, low + size}, {}, planes, 3};
}

TEST(PlaneBody, OfAPointOrAFlatBodyHasABox) {
  for (const Vector3d& size : {Vector3d(0, 0, 0), Vector3d(2, 0, 1), Vector3d(0, 1e-300, 0)}) {
    for (const Vector3d& low : {Vector3d(0, 0, 0), Vector3d(5e6, -3, 0)}) {
      const PlaneBody body(box_of(low, size));
      ASSERT_TRUE(body.box()) << size.transpose() << " at " << low.transpose();
      const double room = 0x1p-44 * (low.cwiseAbs() + size).maxCoeff() + 1e-300;
      EXPECT_LE((body.box()->max() - low - size).maxCoeff(), room);
      EXPECT_LE((low - body.box()->min()).maxCoeff(), room);
    }
  }
}

TEST(PlaneBody, SeesPlanesThatCutLittleOffFarFromTheOrigin) {
  const Vector3d low(5e6, 5e6, 5e6), size(1, 1, 1), n(1, 1, 1);
  const double cut = n.dot(low + size) - 5e-7;
  const PlaneBody body(box_of(low, size, {{n, cut}}));
  EXPECT_NEAR(body.support_bound_up(n), cut, 2 * 0x1p-46 * 5e6);
}

TEST(PlaneBody, OfNothingOrBeyondTheRangeOfDoubleHasNoBox) {
  for (const PlaneBody& body : {PlaneBody(Hull()), PlaneBody(Kdop()), PlaneBody(cube({0, 0, 0}, 1.5e308)),
                                PlaneBody(box_of({2e307, 0, 0}, {7.5e307, 1, 1}))}) {
    EXPECT_FALSE(body.box());
    EXPECT_EQ(body.support_bound_up({1, 0, 0}), kInfinity);
  }
}

TEST(PlaneBody, HasABoxAroundEveryPointOfAHullInExactArithmetic) {
  Random random(14);
  std::size_t judged = 0;
  for (const Scale& scale : {scales()[0], scales()[1], scales()[2], scales()[4], scales()[5]}) {
    for (int i = 0; i < 20; ++i) {
      const Hull hull = cube(random.point(scale), scale.extent).transformed(random.isometry(scale.extent));
      const auto box = PlaneBody(hull).box();
      ASSERT_TRUE(box) << scale.name;
      const double size = (hull.aabb().max() - hull.aabb().min()).maxCoeff();
      EXPECT_LT((box->max() - hull.aabb().max()).maxCoeff(), 1e-9 * (size + scale.offset)) << scale.name;
      for (const Vector3d& p : points_about(random, hull, 0, 30)) {
        if (!inside(hull, exact(p)) && !hull.contains(p)) continue;
        ++judged;
        ASSERT_TRUE(box->contains(p)) << scale.name;
      }
    }
  }
  EXPECT_GT(judged, 1000U);
}

TEST(PlaneBody, HasNoBoxWherePlanesLeaveItOpen) {
  for (const AnyVolume& volume : odd_volumes(1)) {
    const auto* const hull = std::get_if<Hull>(&volume);
    if (hull == nullptr || hull->empty()) continue;
    EXPECT_FALSE(PlaneBody(*hull).box());
    EXPECT_EQ(PlaneBody(*hull).support_bound_up({1, 0, 0}), kInfinity);
  }
  Hull cube_without_lid = cube({0, 0, 0}, 1);
  std::vector<HullPlane> planes = cube_without_lid.planes();
  planes.pop_back();
  EXPECT_FALSE(PlaneBody(Hull(cube_without_lid.vertices(), cube_without_lid.triangles(), planes, 3)).box());
}

}  // namespace
}  // namespace pcl_bv
