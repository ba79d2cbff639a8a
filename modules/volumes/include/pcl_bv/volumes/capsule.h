// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

#include "pcl_bv/volumes/aabb.h"
#include "pcl_bv/volumes/geometry.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// A capsule in the frame and unit of its points: the closed set of all p whose distance from the segment
/// from a to b is at most the radius.
///
/// The empty capsule has radius -1 and ends NaN. A capsule with equal ends is a sphere. A capsule with radius
/// 0 is a segment. Coordinates beyond 1e100 are not supported.
class Capsule {
 public:
  /// Makes the empty capsule.
  Capsule();

  /// Makes a capsule around the segment from a to b. A negative radius gives the empty capsule. Otherwise
  /// throws std::invalid_argument unless all numbers are finite. Stores -0 as 0.
  Capsule(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double radius);

  const Eigen::Vector3d& a() const { return a_; }  ///< First end of the segment; NaN if empty.
  const Eigen::Vector3d& b() const { return b_; }  ///< Second end of the segment; NaN if empty.
  double radius() const { return radius_; }        ///< Radius; -1 if empty.

  /// Returns whether the capsule has no point.
  bool empty() const { return radius_ < 0; }

  /// Returns whether the capsule contains the point. Conservative: true for every point of the capsule, in
  /// spite of rounding errors. False for an empty capsule and for a point with a coordinate that is not
  /// finite. Computed in double, with a tolerance of 2^-48 (|p - a|_1 + |b - a|_1 + radius) + 2^-1022 for
  /// rounding.
  bool contains(const Eigen::Vector3d& point) const;

  double volume() const;           ///< Volume in cubed units; 0 if empty.
  double surface_area() const;     ///< Surface area in squared units; 0 if empty.
  Eigen::Vector3d center() const;  ///< Middle of the segment. NaN if empty.

  /// Returns a point that is farthest along `direction`, which may have any length. For a zero direction,
  /// returns the centre. NaN if empty.
  Eigen::Vector3d support(const Eigen::Vector3d& direction) const;

  /// Returns the distance from the point to the capsule; 0 if contains() is true. NaN if the point has a NaN
  /// coordinate, otherwise infinity if the capsule is empty or the point has an infinite coordinate.
  double distance(const Eigen::Vector3d& point) const;

  /// Returns the part of the ray `origin + t * direction`, t >= 0, inside the capsule; see RayInterval. The
  /// result is computed by Sphere::intersect() and Cylinder::intersect(), whose error bounds apply. Both use
  /// a radius that is larger than the capsule's by about 2^-46 (|b - a|_1 + radius).
  std::optional<RayInterval> intersect(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

  /// Returns the smallest box with double coordinates that contains every point of the capsule, in spite of
  /// rounding errors.
  Aabb aabb() const;

  /// Returns the mesh of two half spheres and the tube between them. The mesh has 24 sides, and its vertices
  /// are on the surface. Returns an empty mesh for an empty capsule.
  Mesh mesh() const;

  /// Returns the transformed capsule. The result contains the exact value of `transform * p` for every point
  /// p of this capsule. The radius grows by the rounding error of the ends and by the error of the matrix,
  /// which is rarely exactly orthonormal.
  Capsule transformed(const Eigen::Isometry3d& transform) const;

 private:
  Eigen::Vector3d a_, b_;
  double radius_;
};

/// Returns whether ends and radius are equal, or both capsules are empty.
bool operator==(const Capsule& a, const Capsule& b);
inline bool operator!=(const Capsule& a, const Capsule& b) {
  return !(a == b);
}

}  // namespace pcl_bv
