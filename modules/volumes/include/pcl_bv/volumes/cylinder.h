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

/// A cylinder in the frame and unit of its points: with q = p - center, |q x axis| <= radius |axis| and
/// |q . axis| <= half_height |axis|, a closed set. The axis has length 1 up to rounding.
///
/// The empty cylinder has radius and half height -1 and centre NaN. Radius or half height 0: a segment, a
/// disc, a point. Coordinates beyond 1e100 are not supported.
class Cylinder {
 public:
  /// The empty cylinder.
  Cylinder();

  /// A negative radius or half height: the empty cylinder. Otherwise all must be finite and the axis not
  /// zero, or std::invalid_argument. An axis that is not of length 1 to 2^-50 is made so. A -0 is stored as
  /// 0.
  Cylinder(const Eigen::Vector3d& center, const Eigen::Vector3d& axis, double radius, double half_height);

  const Eigen::Vector3d& center() const { return center_; }
  const Eigen::Vector3d& axis() const { return axis_; }
  double radius() const { return radius_; }
  double half_height() const { return half_height_; }

  bool empty() const { return radius_ < 0; }

  /// The definition in double, give or take 2^-48 |p - center|_1 for its own rounding: every point inside by
  /// exact arithmetic is contained; it errs only towards true. False for an empty cylinder and a point that
  /// is not finite.
  bool contains(const Eigen::Vector3d& point) const;

  double volume() const;        ///< In cubed units; 0 if empty.
  double surface_area() const;  ///< In squared units, with both ends; 0 if empty.

  /// A point farthest along `direction` (any length). NaN if empty.
  Eigen::Vector3d support(const Eigen::Vector3d& direction) const;

  /// Distance of a point, 0 where contains() holds. Infinity if empty, NaN for a point with a NaN.
  double distance(const Eigen::Vector3d& point) const;

  /// Where the ray origin + t direction is inside, as RayInterval says. Each end is in a cylinder greater by
  /// at most 2^-43 (|origin - center|_1 + radius + half height) each way.
  std::optional<RayInterval> intersect(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

  /// A box around the cylinder, by exact arithmetic; greater than the smallest by some 2^-46 of the size.
  Aabb aabb() const;

  /// A prism of 48 sides whose edges lie on the surface, and the two ends. Nothing if empty.
  Mesh mesh() const;

  /// The moved cylinder. Radius and half height grow by the rounding of centre and axis and by what the
  /// stored matrix stretches, so that the image of every point, by exact arithmetic, is inside.
  Cylinder transformed(const Eigen::Isometry3d& transform) const;

 private:
  Eigen::Vector3d center_, axis_;
  double radius_, half_height_;
};

/// The same numbers, or both empty.
bool operator==(const Cylinder& a, const Cylinder& b);
inline bool operator!=(const Cylinder& a, const Cylinder& b) {
  return !(a == b);
}

}  // namespace pcl_bv
