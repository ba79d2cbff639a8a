// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

#include "pcl_bv/volumes/aabb.h"
#include "pcl_bv/volumes/geometry.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// A float copy of a Sphere that encloses the Sphere. The radius includes the rounding error of the centre
/// and is rounded up. A radius beyond the range of float is infinite. An empty sphere has centre NaN and
/// radius -1.
struct FloatSphere {
  Eigen::Vector3f center;
  float radius;
};

/// A solid sphere in the frame and unit of its points: the closed set of all p with |p - center| <= radius.
///
/// The empty sphere has radius -1 and centre NaN; merging the empty sphere into another sphere changes
/// nothing. A sphere of radius 0 is a point. Coordinates beyond 1e100 are not supported.
class Sphere {
 public:
  /// Makes the empty sphere.
  Sphere();

  /// Makes a sphere. A negative radius gives the empty sphere. Otherwise throws std::invalid_argument unless
  /// centre and radius are finite. Stores -0 as 0.
  Sphere(const Eigen::Vector3d& center, double radius);

  const Eigen::Vector3d& center() const { return center_; }  ///< Centre; NaN if empty.
  double radius() const { return radius_; }                  ///< Radius; -1 if empty.

  /// Returns whether the sphere has no point.
  bool empty() const { return radius_ < 0; }

  /// Returns whether the sphere contains the point. Conservative: true for every point of the sphere, in
  /// spite of rounding errors. False for an empty sphere and for a point with a coordinate that is not
  /// finite.
  ///
  /// Computed in double, with q = point - center:
  /// (qx^2 + qy^2) + qz^2 <= radius^2 (1 + 16 * 2^-53) + 2^-1022.
  bool contains(const Eigen::Vector3d& point) const;

  /// Returns the largest squared distance from the centre that contains() accepts; -1 if empty.
  double max_squared_distance() const;

  double volume() const;        ///< Volume in cubed units; 0 if empty.
  double surface_area() const;  ///< Surface area in squared units; 0 if empty.

  /// Returns the point of the sphere that is farthest along `direction`, which may have any length. For a
  /// zero direction, returns the centre. NaN if empty.
  Eigen::Vector3d support(const Eigen::Vector3d& direction) const;

  /// Returns the distance from the point to the sphere; 0 if contains() is true. NaN if the point has a NaN
  /// coordinate, otherwise infinity if the sphere is empty or the point has an infinite coordinate.
  double distance(const Eigen::Vector3d& point) const;

  /// Returns the part of the ray `origin + t * direction`, t >= 0, inside the sphere; see RayInterval. A ray
  /// hits if contains() is true for its origin. Both ends of the interval lie in a concentric sphere whose
  /// radius is larger by at most 2^-46 (|origin - center|_1 + radius) + 2^-510.
  std::optional<RayInterval> intersect(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

  /// Returns whether the spheres have a point in common. Conservative: true for all spheres that overlap, in
  /// spite of rounding errors. False if either sphere is empty. Tests the centre of the other sphere as
  /// contains() tests a point, with the sum of the radii as the radius.
  bool overlaps(const Sphere& other) const;

  /// Returns the smallest box with double coordinates that contains every point of the sphere, in spite of
  /// rounding errors.
  Aabb aabb() const;

  /// Returns an icosahedron that is subdivided twice. The mesh has 162 vertices, on the surface, and 320
  /// triangles. Returns an empty mesh for an empty sphere.
  Mesh mesh() const;

  /// Returns the transformed sphere. The result contains the exact value of `transform * p` for every point p
  /// of this sphere. The radius grows by the rounding error of the centre and by the error of the matrix,
  /// which is rarely exactly orthonormal.
  Sphere transformed(const Eigen::Isometry3d& transform) const;

  /// Enlarges the sphere to the smallest sphere around this sphere and the point, plus rounding errors. This
  /// is the step of Ritter (1990). If the point is proven to be inside, the sphere does not change. A point
  /// with a coordinate that is not finite is ignored.
  Sphere& extend(const Eigen::Vector3d& point);

  /// Enlarges the sphere to the smallest sphere around this sphere and the other sphere, plus rounding
  /// errors. If one sphere is proven to enclose the other, the result is the enclosing sphere, unchanged.
  /// Merging is commutative, but not associative.
  Sphere& merge(const Sphere& other);

  /// Returns a float copy that encloses the sphere.
  FloatSphere cast_float() const;

 private:
  Eigen::Vector3d center_;
  double radius_;
};

/// Returns whether centre and radius are equal, or both spheres are empty.
bool operator==(const Sphere& a, const Sphere& b);
inline bool operator!=(const Sphere& a, const Sphere& b) {
  return !(a == b);
}

}  // namespace pcl_bv
