// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Volumes of every kind to try pairs on, and one that just reaches a point.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "kdop_sets.h"
#include "obbs.h"
#include "pcl_bv/numeric/expansion.h"
#include "pcl_bv/volumes/any_volume.h"
#include "round_volumes.h"

namespace pcl_bv::testing {
using namespace detail;

inline constexpr int kKinds = 9;

inline bool inside(const AnyVolume& volume, const ExactPoint& p) {
  return std::visit([&](const auto& v) { return inside(v, p); }, volume);
}

/// The hull of points in general position, by trying every plane; its planes hold the points exactly.
inline Hull hull_around(const std::vector<Vector3d>& points) {
  std::vector<Hull::Triangle> triangles;
  std::vector<HullPlane> planes;
  const int n = static_cast<int>(points.size());
  const auto at = [&](int i) { return points[static_cast<std::size_t>(i)]; };
  for (int i = 0; i < n; ++i) {
    for (int j = i + 1; j < n; ++j) {
      for (int k = i + 1; k < n; ++k) {
        if (k == j) continue;
        const Vector3d normal = (at(j) - at(i)).cross(at(k) - at(i)).stableNormalized();
        const bool outer = std::all_of(points.begin(), points.end(), [&](const Vector3d& p) {
          return p == at(i) || p == at(j) || p == at(k) || normal.dot(p - at(i)) < 0;
        });
        if (!outer) continue;
        double offset = -std::numeric_limits<double>::infinity();
        for (const Vector3d& p : points)
          offset = std::max(offset, Expansion().add_dot(normal, p).up());
        triangles.push_back({i, j, k});
        planes.push_back({normal, offset});
      }
    }
  }
  return {points, triangles, planes, 3};
}

/// The form of a volume of a kind, without its size and its place.
struct Form {
  Form(Random& random, int of_kind)
      : kind(of_kind),
        axes(random.isometry(1).linear()),
        size(random.vector(1).cwiseAbs()),
        set(kdop_sets()[static_cast<std::size_t>(random.uniform(0, 6))]) {
    size += Vector3d::Constant(0.05);
    if (random.uniform(0, 1) < 0.3) axes = orthonormal_axes(Eigen::Matrix3d::Identity());
    for (int i = 0; i < 6; ++i) {  // around the middle
      points.push_back(random.vector(1).normalized());
      points.push_back(-points.back());
    }
  }

  /// About a place, half of `t` wide or a few times that; grows with t.
  AnyVolume volume(const Vector3d& at, double t) const {
    switch (kind) {
      case 0:
        return Aabb(at - t * size, at + t * size);
      case 1: {
        Kdop kdop(set);
        for (const Vector3d& p : points)
          kdop.extend(at + t * p);
        return kdop;
      }
      case 2:
        return Sphere(at, t);
      case 3:
        return Obb(at, axes, t * size);
      case 4:
        return Cylinder(at, axes.col(0), t * size.x(), t * size.y());
      case 5:
        return Capsule(at - t * size.z() * axes.col(0), at + t * size.z() * axes.col(0), t * size.x());
      case 6:
        return Ellipsoid(at, axes, t * size);
      default: {
        std::vector<Vector3d> vertices;
        for (const Vector3d& p : points)
          vertices.push_back(at + t * p);
        if (kind == 7) return hull_around(vertices);
        return prism_around(vertices, axes);
      }
    }
  }

  int kind;
  Eigen::Matrix3d axes;
  Vector3d size;
  std::shared_ptr<const KdopSet> set;
  std::vector<Vector3d> points;
};

/// The volume of the form about a place that holds the point and is smallest, to rounding.
inline AnyVolume just_reaching(const Form& form, const Vector3d& at, const ExactPoint& point, double extent) {
  double out = 0, in = extent;
  while (!inside(form.volume(at, in), point)) {
    out = in;
    in *= 2;
  }
  for (int i = 0; i < 60 && out < in; ++i) {
    const double middle = out + (in - out) / 2;
    if (middle == out || middle == in) break;
    (inside(form.volume(at, middle), point) ? in : out) = middle;
  }
  return form.volume(at, in);
}

/// One point as a volume of a kind.
inline AnyVolume point_volume(int kind, const Vector3d& p) {
  const Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  switch (kind) {
    case 0:
      return Aabb(p, p);
    case 1:
      return Kdop(KdopSet::dop6()).extend(p);
    case 2:
      return Sphere(p, 0);
    case 3:
      return Obb(p, axes, Vector3d::Zero());
    case 4:
      return Cylinder(p, Vector3d(1, 2, 3), 0, 0);
    case 5:
      return Capsule(p, p, 0);
    case 6:
      return Ellipsoid(p, axes, Vector3d::Zero());
    case 8:
      return prism_around({p}, axes);
    default: {
      std::vector<HullPlane> planes;
      for (int k = 0; k < 3; ++k) {
        planes.push_back({Vector3d::Unit(k), p[k]});
        planes.push_back({-Vector3d::Unit(k), -p[k]});
      }
      return Hull({p}, {}, planes, 0);
    }
  }
}

inline AnyVolume empty_volume(int kind) {
  static const AnyVolume all[kKinds] = {Aabb(),    Kdop(),      Sphere(), Obb(),  Cylinder(),
                                        Capsule(), Ellipsoid(), Hull(),   Prism()};
  return all[kind];
}

}  // namespace pcl_bv::testing
