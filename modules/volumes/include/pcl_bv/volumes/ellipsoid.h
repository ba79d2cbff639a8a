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

/// An ellipsoid in the frame and unit of its points: the sum over i of ((axis i . (p - center)) / radius i)^2
/// is at most 1, a closed set; where a radius is 0, axis i . (p - center) = 0 instead. Axes are the columns
/// of a matrix, orthonormal to 1e-12.
///
/// The empty ellipsoid has radii -1 and centre NaN. Flat ones (some or all radii 0) are volumes like any
/// other. Coordinates beyond 1e100 are not supported.
class Ellipsoid {
 public:
  /// The empty ellipsoid.
  Ellipsoid();

  /// Any negative radius: the empty ellipsoid. Otherwise all must be finite and the axes orthonormal to
  /// 1e-12, or std::invalid_argument. A -0 is stored as 0.
  Ellipsoid(const Eigen::Vector3d& center, const Eigen::Matrix3d& axes, const Eigen::Vector3d& radii);

  const Eigen::Vector3d& center() const { return center_; }
  const Eigen::Matrix3d& axes() const { return axes_; }
  const Eigen::Vector3d& radii() const { return radii_; }

  bool empty() const { return radii_[0] < 0; }

  /// The definition in double, each axis i . (p - center) taken to be nearer 0 by 2^-49 |p - center|_1, and 1
  /// to be 1 + 2^-48: every point inside by exact arithmetic is contained; it errs only towards true. False
  /// for an empty ellipsoid and a point that is not finite.
  bool contains(const Eigen::Vector3d& point) const;

  double volume() const;  ///< In cubed units; 0 if empty or flat.

  /// In squared units; both sides of a flat one count. 0 if empty. Carlson 1995, to about 1e-14.
  double surface_area() const;

  /// The point farthest along `direction` (any length; the centre for 0). NaN if empty.
  Eigen::Vector3d support(const Eigen::Vector3d& direction) const;

  /// Distance of a point, 0 where contains() holds, to about 1e-14 of the greater of it and the size.
  /// Infinity if empty, NaN for a point with a NaN. Eberly 2013: a root by bisection.
  double distance(const Eigen::Vector3d& point) const;

  /// Where the ray origin + t direction is inside, as RayInterval says. Each end is in an ellipsoid whose
  /// radii are greater by 2^-44 (|origin - center|_1 + the greatest radius), times the quotient of the
  /// greatest and the least.
  std::optional<RayInterval> intersect(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

  /// A box around the ellipsoid, by exact arithmetic; greater than the smallest by some 1e-12 of the size at
  /// most.
  Aabb aabb() const;

  /// 24 by 13 points of the surface and the faces between them. Nothing if empty.
  Mesh mesh() const;

  /// The moved ellipsoid. The radii grow by the rounding of centre and axes, so that the image of every
  /// point, by exact arithmetic, is inside; radii less than 2^-30 of the greatest first become that.
  Ellipsoid transformed(const Eigen::Isometry3d& transform) const;

 private:
  Eigen::Vector3d center_;
  Eigen::Matrix3d axes_;
  Eigen::Vector3d radii_;
};

/// The same numbers, or both empty.
bool operator==(const Ellipsoid& a, const Ellipsoid& b);
inline bool operator!=(const Ellipsoid& a, const Ellipsoid& b) {
  return !(a == b);
}

}  // namespace pcl_bv
