// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The judge of round_*_test.cpp: predicates of the round shapes and the hull in rationals, and one of each
// kind.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "exact.h"
#include "pcl_bv/numeric/expansion.h"
#include "pcl_bv/volumes/any_volume.h"
#include "pcl_bv/volumes/outline.h"

namespace pcl_bv::testing {

using Eigen::Vector2d;
using Eigen::Vector3d;

inline ExactPoint minus(const ExactPoint& a, const ExactPoint& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline Rational product(const ExactPoint& a, const ExactPoint& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline bool inside(const Cylinder& c, const ExactPoint& p) {
  const ExactPoint q = minus(p, exact(c.center())), a = exact(c.axis());
  const Rational along = product(q, a), aa = product(a, a), r(c.radius()), h(c.half_height());
  return along * along <= h * h * aa && product(q, q) * aa - along * along <= r * r * aa;
}

inline bool inside(const Capsule& c, const ExactPoint& p) {
  const ExactPoint a = exact(c.a()), e = minus(exact(c.b()), a), q = minus(p, a);
  const Rational ee = product(e, e), along = product(q, e), rr = Rational(c.radius()) * Rational(c.radius());
  if (along <= 0) return product(q, q) <= rr;
  if (along >= ee) return squared_distance(p, exact(c.b())) <= rr;
  return product(q, q) * ee - along * along <= rr * ee;
}

inline bool inside(const Ellipsoid& c, const ExactPoint& p) {
  const ExactPoint q = minus(p, exact(c.center()));
  Rational sum = 0;
  for (int i = 0; i < 3; ++i) {
    const Rational along = product(q, exact(Vector3d(c.axes().col(i)))), r(c.radii()[i]);
    if (r == 0 && along != 0) return false;
    if (r != 0) sum += along * along / (r * r);
  }
  return sum <= 1;
}

inline bool inside(const Hull& hull, const ExactPoint& p) {
  for (const HullPlane& plane : hull.planes()) {
    if (dot(plane.normal, p) > Rational(plane.offset)) return false;
  }
  return true;
}

inline bool inside(const Prism& prism, const ExactPoint& p) {
  const Rational u = dot(prism.axes().col(0), p), v = dot(prism.axes().col(1), p), h = dot(prism.up(), p);
  if (prism.empty() || h < Rational(prism.low()) || h > Rational(prism.high())) return false;
  Vector2d low = prism.outline()[0], high = low;
  for (std::size_t i = 0; i < prism.outline().size(); ++i) {
    const Vector2d &a = prism.outline()[i], &b = prism.outline()[(i + 1) % prism.outline().size()];
    low = low.cwiseMin(a);
    high = high.cwiseMax(a);
    const Rational left = (Rational(b.x()) - Rational(a.x())) * (v - Rational(a.y()));
    const Rational right = (Rational(b.y()) - Rational(a.y())) * (u - Rational(a.x()));
    if (left < right) return false;
  }
  return u >= Rational(low.x()) && u <= Rational(high.x()) && v >= Rational(low.y()) &&
         v <= Rational(high.y());
}

/// The prism of the points along the axes, around what rounding leaves of their coordinates.
inline Prism prism_around(const std::vector<Vector3d>& points, const Eigen::Matrix3d& axes) {
  std::vector<detail::PlaneBox> boxes;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vector3d& p : points) {
    detail::Expansion along[3];
    for (int i = 0; i < 3; ++i)
      along[i].add_dot(axes.col(i), p);
    boxes.push_back({{along[0].down(), along[1].down()}, {along[0].up(), along[1].up()}});
    low = std::min(low, along[2].down());
    high = std::max(high, along[2].up());
  }
  return {axes, detail::outline_around(boxes), low, high};
}

inline Hull cube(const Vector3d& low, double side) {
  std::vector<Vector3d> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(low + side * Vector3d(i & 1, i >> 1 & 1, i >> 2 & 1));
  std::vector<HullPlane> planes;
  for (int k = 0; k < 3; ++k) {
    planes.push_back({Vector3d::Unit(k), corners[7][k]});
    planes.push_back({-Vector3d::Unit(k), -low[k]});
  }
  return {corners,
          {{0, 4, 6},
           {0, 6, 2},
           {1, 3, 7},
           {1, 7, 5},
           {0, 1, 5},
           {0, 5, 4},
           {2, 6, 7},
           {2, 7, 3},
           {0, 2, 3},
           {0, 3, 1},
           {4, 5, 7},
           {4, 7, 6}},
          planes,
          3};
}

// One of each kind at a scale, of about its extent.
inline std::vector<AnyVolume> volumes(Random& random, const Scale& scale) {
  const double s = scale.extent;
  Eigen::Matrix3d axes = random.isometry(1).linear();
  const Vector3d a = random.point(scale);
  return {Cylinder(random.point(scale), random.vector(1), 0.5 * s, 0.7 * s),
          Capsule(a, a + random.vector(s), 0.3 * s),
          Ellipsoid(random.point(scale), axes, Vector3d(s, 0.5 * s, 0.1 * s)),
          Ellipsoid(random.point(scale), axes, Vector3d(s, 1e-3 * s, 1e-5 * s)),
          cube(random.point(scale), s),
          prism_around(random.cloud(scale, Span::solid, 12), orthonormal_axes(random.isometry(1).linear())),
          prism_around(random.cloud(scale, Span::solid, 12), Eigen::Matrix3d::Identity())};
}

}  // namespace pcl_bv::testing
