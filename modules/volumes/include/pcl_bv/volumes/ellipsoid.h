// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

#include "pcl_bv/volumes/aabb.h"
#include "pcl_bv/volumes/geometry.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// An ellipsoid in the frame and unit of its points: the closed set of all p for which the sum over i of
/// (axis i . (p - center) / radius i)^2 is at most 1. For a radius of 0, the term is replaced by the
/// condition axis i . (p - center) = 0. The axes are the columns of a matrix that is orthonormal to 1e-12.
///
/// The empty ellipsoid has radii -1 and centre NaN. A flat ellipsoid, with some or all radii 0, is a valid
/// volume. Coordinates beyond 1e100 are not supported.
class Ellipsoid {
 public:
  /// Makes the empty ellipsoid.
  Ellipsoid();

  /// Makes an ellipsoid. Any negative radius gives the empty ellipsoid. Otherwise throws
  /// std::invalid_argument unless all numbers are finite and the axes are orthonormal to 1e-12. Stores -0 as
  /// 0.
  Ellipsoid(const Eigen::Vector3d& center, const Eigen::Matrix3d& axes, const Eigen::Vector3d& radii);

  const Eigen::Vector3d& center() const { return center_; }  ///< Centre; NaN if empty.
  const Eigen::Matrix3d& axes() const { return axes_; }      ///< The axes as columns.
  const Eigen::Vector3d& radii() const { return radii_; }    ///< Radius along each axis; -1 if empty.

  /// Returns whether the ellipsoid has no point.
  bool empty() const { return radii_[0] < 0; }

  /// Returns whether the ellipsoid contains the point. Conservative: true for every point of the ellipsoid,
  /// in spite of rounding errors. False for an empty ellipsoid and for a point with a coordinate that is not
  /// finite.
  ///
  /// Computed in double: each product axis i . (p - center) is moved towards 0 by 2^-49 |p - center|_1 +
  /// 2^-1022. The sum in the definition above is then compared with 1 + 2^-48.
  bool contains(const Eigen::Vector3d& point) const;

  double volume() const;  ///< Volume in cubed units; 0 if empty or flat.

  /// Returns the surface area in squared units, accurate to about 1e-14 (Carlson 1995). Both sides of a flat
  /// ellipsoid count. 0 if empty.
  double surface_area() const;

  /// Returns a point that is farthest along `direction`, which may have any length. For a zero direction,
  /// returns the centre. NaN if empty.
  Eigen::Vector3d support(const Eigen::Vector3d& direction) const;

  /// Returns the distance from the point to the ellipsoid; 0 if contains() is true. NaN if the point has a
  /// NaN coordinate, otherwise infinity if the ellipsoid is empty or the point has an infinite coordinate.
  /// Accurate to about 1e-14 of the distance or the size, whichever is larger (Eberly 2013, with bisection).
  double distance(const Eigen::Vector3d& point) const;

  /// Returns the part of the ray `origin + t * direction`, t >= 0, inside the ellipsoid; see RayInterval. Let
  /// R be the largest radius, r the smallest radius and s = |origin - center|_1 + R. Both ends of the
  /// interval lie in an ellipsoid whose radii are larger by the minimum of 2^-44 * s * R / r and 2^-21 *
  /// sqrt(s * R).
  std::optional<RayInterval> intersect(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

  /// Returns a box that contains every point of the ellipsoid, in spite of rounding errors. The box exceeds
  /// the smallest such box by at most about 1e-12 of the size of the ellipsoid.
  Aabb aabb() const;

  /// Returns a mesh of 13 rings of 24 vertices each. The vertices are on the surface. Returns an empty mesh
  /// for an empty ellipsoid.
  Mesh mesh() const;

  /// Returns the transformed ellipsoid. The result contains the exact value of `transform * p` for every
  /// point p of this ellipsoid. Radii below 2^-30 of the largest radius are first raised to that value. Then
  /// all radii grow by one factor that covers the rounding error of centre and axes.
  Ellipsoid transformed(const Eigen::Isometry3d& transform) const;

 private:
  Eigen::Vector3d center_;
  Eigen::Matrix3d axes_;
  Eigen::Vector3d radii_;
};

/// Returns whether centre, axes and radii are equal, or both ellipsoids are empty.
bool operator==(const Ellipsoid& a, const Ellipsoid& b);
inline bool operator!=(const Ellipsoid& a, const Ellipsoid& b) {
  return !(a == b);
}

}  // namespace pcl_bv
