// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

#include "pcl_bv/volumes/aabb.h"
#include "pcl_bv/volumes/mesh.h"
#include "pcl_bv/volumes/ray_interval.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// A capsule in the frame and unit of its points: all p with a distance from the segment a b of at most the
/// radius, a closed set.
///
/// The empty capsule has radius -1 and ends NaN. Equal ends: a sphere; radius 0: a segment. Coordinates
/// beyond 1e100 are not supported.
class Capsule {
 public:
  /// The empty capsule.
  Capsule();

  /// A negative radius: the empty capsule. Otherwise all must be finite, or std::invalid_argument. A -0 is
  /// stored as 0.
  Capsule(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double radius);

  const Eigen::Vector3d& a() const { return a_; }
  const Eigen::Vector3d& b() const { return b_; }
  double radius() const { return radius_; }

  bool empty() const { return radius_ < 0; }

  /// The definition in double, give or take 2^-48 (|p - a|_1 + |b - a|_1 + radius) for its own rounding:
  /// every point inside by exact arithmetic is contained; it errs only towards true. False for an empty
  /// capsule and a point that is not finite.
  bool contains(const Eigen::Vector3d& point) const;

  double volume() const;           ///< In cubed units; 0 if empty.
  double surface_area() const;     ///< In squared units; 0 if empty.
  Eigen::Vector3d center() const;  ///< The middle of the segment. NaN if empty.

  /// The point farthest along `direction` (any length; the centre for 0). NaN if empty.
  Eigen::Vector3d support(const Eigen::Vector3d& direction) const;

  /// Distance of a point, 0 where contains() holds. Infinity if empty, NaN for a point with a NaN.
  double distance(const Eigen::Vector3d& point) const;

  /// Where the ray origin + t direction is inside, as RayInterval says: made of Sphere::intersect() and
  /// Cylinder::intersect().
  std::optional<RayInterval> intersect(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

  /// The smallest box in double around the capsule: encloses it by exact arithmetic.
  Aabb aabb() const;

  /// Two half spheres and what is between them, with 24 sides, vertices on the surface. Nothing if empty.
  Mesh mesh() const;

  /// The moved capsule. The radius grows by the rounding of the ends and by what the stored matrix stretches,
  /// so that the image of every point, by exact arithmetic, is inside.
  Capsule transformed(const Eigen::Isometry3d& transform) const;

 private:
  Eigen::Vector3d a_, b_;
  double radius_;
};

/// The same numbers, or both empty.
bool operator==(const Capsule& a, const Capsule& b);
inline bool operator!=(const Capsule& a, const Capsule& b) {
  return !(a == b);
}

}  // namespace pcl_bv
