// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

#include "pcl_bv/volumes/aabb.h"
#include "pcl_bv/volumes/geometry.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// A float copy of a Cylinder's centre, axis and radius. The infinite cylinder around the axis encloses the
/// Cylinder: the radius includes the distance by which rounding moves the axis. An empty cylinder has centre
/// and axis NaN and radius -1.
struct FloatCylinder {
  Eigen::Vector3f center, axis;
  float radius;
};

/// A cylinder in the frame and unit of its points: the closed set of all p = center + q with
/// |q x axis| <= radius |axis| and |q . axis| <= half_height |axis|. The axis has length 1 up to rounding.
///
/// The empty cylinder has radius and half height -1 and centre NaN. A cylinder with radius 0 is a segment, a
/// cylinder with half height 0 is a disc, and a cylinder with both 0 is a point. Coordinates beyond 1e100 are
/// not supported.
class Cylinder {
 public:
  /// Makes the empty cylinder.
  Cylinder();

  /// Makes a cylinder. A negative radius or half height gives the empty cylinder. Otherwise throws
  /// std::invalid_argument unless all numbers are finite and the axis is not zero. An axis whose squared
  /// length differs from 1 by at most 2^-50 is stored unchanged; any other axis is normalised. Stores -0 as
  /// 0.
  Cylinder(const Eigen::Vector3d& center, const Eigen::Vector3d& axis, double radius, double half_height);

  const Eigen::Vector3d& center() const { return center_; }  ///< Centre; NaN if empty.
  const Eigen::Vector3d& axis() const { return axis_; }      ///< Direction of the axis, of length 1.
  double radius() const { return radius_; }                  ///< Radius; -1 if empty.
  double half_height() const { return half_height_; }        ///< Half the height; -1 if empty.

  /// Returns whether the cylinder has no point.
  bool empty() const { return radius_ < 0; }

  /// Returns whether the cylinder contains the point. Conservative: true for every point of the cylinder, in
  /// spite of rounding errors. False for an empty cylinder and for a point with a coordinate that is not
  /// finite. Computed in double, with a tolerance of 2^-48 |p - center|_1 + 2^-1022 for rounding.
  bool contains(const Eigen::Vector3d& point) const;

  double volume() const;        ///< Volume in cubed units; 0 if empty.
  double surface_area() const;  ///< Surface area in squared units, ends included; 0 if empty.

  /// Returns a point that is farthest along `direction` (any length). NaN if empty.
  Eigen::Vector3d support(const Eigen::Vector3d& direction) const;

  /// Returns the distance from the point to the cylinder; 0 if contains() is true. NaN if the point has a NaN
  /// coordinate, otherwise infinity if the cylinder is empty or the point has an infinite coordinate.
  double distance(const Eigen::Vector3d& point) const;

  /// Returns the part of the ray `origin + t * direction`, t >= 0, inside the cylinder; see RayInterval. Both
  /// ends of the interval lie in a cylinder whose radius and half height are larger by at most 2^-43 (|origin
  /// - center|_1 + radius + half_height).
  std::optional<RayInterval> intersect(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

  /// Returns a box that contains every point of the cylinder, in spite of rounding errors. The box exceeds
  /// the smallest such box by about 2^-46 of the size of the cylinder.
  Aabb aabb() const;

  /// Returns the mesh of a prism with 48 sides and two end polygons. The edges between the sides lie on the
  /// surface. Returns an empty mesh for an empty cylinder.
  Mesh mesh() const;

  /// Returns the transformed cylinder. The result contains the exact value of `transform * p` for every point
  /// p of this cylinder. Radius and half height grow by the rounding errors of centre and axis, and by the
  /// error of the matrix, which is rarely exactly orthonormal.
  Cylinder transformed(const Eigen::Isometry3d& transform) const;

  /// Returns a float copy of centre, axis and radius. The infinite cylinder of this axis and radius encloses
  /// the cylinder.
  FloatCylinder cast_float() const;

 private:
  Eigen::Vector3d center_, axis_;
  double radius_, half_height_;
};

/// Returns whether centre, axis, radius and half height are equal, or both cylinders are empty.
bool operator==(const Cylinder& a, const Cylinder& b);
inline bool operator!=(const Cylinder& a, const Cylinder& b) {
  return !(a == b);
}

}  // namespace pcl_bv
