// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Volumes of every kind, flat ones among them, and points about them.
#pragma once

#include <memory>
#include <vector>

#include "kdop_sets.h"
#include "obbs.h"
#include "pcl_bv/numeric/constants.h"
#include "round_volumes.h"

namespace pcl_bv::testing {
using namespace detail;

inline std::vector<AnyVolume> volumes_of_every_kind(Random& random, const Scale& scale) {
  const double s = scale.extent;
  std::vector<AnyVolume> all = volumes(random, scale);
  const std::vector<Vector3d> cloud = random.cloud(scale, Span::solid, 20);
  all.push_back(around(Aabb(), cloud));
  all.push_back(around(Aabb(), {cloud.front()}));
  all.push_back(Sphere(random.point(scale), 0.6 * s));
  all.push_back(Sphere(random.point(scale), 0));
  all.push_back(random_obb(random, scale));
  all.push_back(Obb(random.point(scale), random.isometry(1).linear(), Vector3d(s, 0, 0.2 * s)));
  all.push_back(Cylinder(random.point(scale), random.vector(1), 0.5 * s, 0));
  all.push_back(Capsule(cloud[0], cloud[0], 0.3 * s));
  all.push_back(Ellipsoid(random.point(scale), random.isometry(1).linear(), Vector3d(s, 0.5 * s, 0)));
  all.push_back(Ellipsoid(random.point(scale), random.isometry(1).linear(), Vector3d::Zero()));
  all.push_back(prism_around({cloud[0], cloud[1]}, orthonormal_axes(random.isometry(1).linear())));
  all.push_back(prism_around({cloud[0], cloud[1]}, Eigen::Matrix3d::Identity()));
  all.push_back(prism_around({cloud[0]}, Eigen::Matrix3d::Identity()));
  for (const auto& set : kdop_sets())
    all.push_back(around(Kdop(set), cloud));
  if (s >= 1e-100 && s <= 1e38) {  // Hull::transformed() multiplies
    all.push_back(cube(random.point(scale), s).transformed(random.isometry(s)));
  }
  return all;
}

/// On the surface and a few units in the last place from it, `padding` beyond, and anywhere near.
inline std::vector<Vector3d> points_about(Random& random, const AnyVolume& volume, double padding,
                                          int directions) {
  const Aabb box = aabb(volume);
  const double size = (box.max() - box.min()).maxCoeff();
  std::vector<Vector3d> points;
  for (int i = 0; i < directions; ++i) {
    const Vector3d direction = i < 3 ? Vector3d(Vector3d::Unit(i)) : random.vector(1).normalized();
    for (const double out : {0.0, padding, 0.5 * padding}) {
      const Vector3d surface = support(volume, direction) + out * direction;
      points.push_back(surface);
      for (const double towards : {-kInfinity, kInfinity}) {
        Vector3d near = surface;
        near[i % 3] = std::nextafter(near[i % 3], towards);
        points.push_back(near);
      }
    }
    points.push_back(center(volume) + random.vector(size + 2 * padding));
  }
  return points;
}

}  // namespace pcl_bv::testing
