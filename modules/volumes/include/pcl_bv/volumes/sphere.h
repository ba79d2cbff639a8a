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

/// A copy of a Sphere for float consumers. The radius has grown by the rounding of the centre and is rounded
/// up, so it encloses the sphere; beyond the range of float it is infinite. An empty sphere: centre NaN,
/// radius -1.
struct FloatSphere {
  Eigen::Vector3f center;
  float radius;
};

/// A solid sphere in the frame and unit of its points: |p - center| <= radius, a closed set.
///
/// The empty sphere (the identity of merge) has radius -1 and centre NaN. Radius 0 is a point. Coordinates
/// beyond 1e100 are not supported.
class Sphere {
 public:
  /// The empty sphere.
  Sphere();

  /// A negative radius: the empty sphere. Otherwise all must be finite, or std::invalid_argument. A -0 is
  /// stored as 0.
  Sphere(const Eigen::Vector3d& center, double radius);

  const Eigen::Vector3d& center() const { return center_; }
  double radius() const { return radius_; }

  bool empty() const { return radius_ < 0; }

  /// With q = point - center: (qx^2 + qy^2) + qz^2 <= radius^2 (1 + 16 2^-53) + 2^-1022, in double. So every
  /// point inside by exact arithmetic is contained; it errs only towards true. False for an empty sphere and
  /// for a point that is not finite.
  bool contains(const Eigen::Vector3d& point) const;

  /// What contains() compares squared distances with; -1 if empty.
  double contained_square() const;

  double volume() const;        ///< In cubed units; 0 if empty.
  double surface_area() const;  ///< In squared units; 0 if empty.

  /// The point of the sphere farthest along `direction` (any length; the centre for 0). NaN if empty.
  Eigen::Vector3d support(const Eigen::Vector3d& direction) const;

  /// Distance of a point, 0 where contains() holds. Infinity if empty, NaN for a point with a NaN.
  double distance(const Eigen::Vector3d& point) const;

  /// Where the ray origin + t direction is inside, as RayInterval says; where contains() holds for the
  /// origin, the ray hits. Each end is in a sphere whose radius is greater by at most 2^-46 (|origin -
  /// center|_1 + radius) + 2^-510.
  std::optional<RayInterval> intersect(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

  /// Whether the two have a point in common: contains() of the other's centre for the sum of the radii. So it
  /// errs only towards true. False if either is empty.
  bool overlaps(const Sphere& other) const;

  /// The smallest box in double around the sphere: encloses it by exact arithmetic.
  Aabb aabb() const;

  /// An icosahedron split twice: 162 vertices, which lie on the sphere, and 320 triangles. Nothing if empty.
  Mesh mesh() const;

  /// The moved sphere. The radius grows by the rounding of the centre and by what the stored matrix stretches
  /// (an isometry in double is never quite one), so that the image of every point, by exact arithmetic, is
  /// inside.
  Sphere transformed(const Eigen::Isometry3d& transform) const;

  /// Grows to hold the point: the smallest sphere around both, give or take rounding, which it adds (the step
  /// of Ritter 1990). Unchanged if the point is inside by exact arithmetic. A point with a coordinate that is
  /// not finite is ignored.
  Sphere& extend(const Eigen::Vector3d& point);

  /// Grows to the smallest sphere around both, give or take rounding, which it adds. If one encloses the
  /// other by exact arithmetic, the result is that one, unchanged. Commutative, but not associative.
  Sphere& merge(const Sphere& other);

  FloatSphere cast_float() const;

 private:
  Eigen::Vector3d center_;
  double radius_;
};

/// The same numbers, or both empty.
bool operator==(const Sphere& a, const Sphere& b);
inline bool operator!=(const Sphere& a, const Sphere& b) {
  return !(a == b);
}

}  // namespace pcl_bv
