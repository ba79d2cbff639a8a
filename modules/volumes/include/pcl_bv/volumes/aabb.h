// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <optional>

#include "pcl_bv/volumes/geometry.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// A float copy of an Aabb, rounded outward so that the copy encloses the box. A bound beyond the range of
/// float becomes the largest finite float or infinity.
struct FloatAabb {
  Eigen::Vector3f min;
  Eigen::Vector3f max;
};

/// An axis-aligned box in the frame and unit of its points: the closed set of all p with min <= p <= max in
/// each coordinate.
///
/// The empty box has min = +infinity and max = -infinity; merging the empty box into another box changes
/// nothing. A flat box, whose min equals its max along one, two or all three axes, is a valid volume.
/// Coordinates beyond 1e100 may overflow in functions that multiply them, such as volume().
class Aabb {
 public:
  /// Makes the empty box.
  Aabb();

  /// Makes the box between two corners. If any min exceeds its max, the box is empty. Otherwise throws
  /// std::invalid_argument unless all six numbers are finite. Stores -0 as 0.
  Aabb(const Eigen::Vector3d& min, const Eigen::Vector3d& max);

  const Eigen::Vector3d& min() const { return min_; }  ///< Minimum coordinates; +infinity if empty.
  const Eigen::Vector3d& max() const { return max_; }  ///< Maximum coordinates; -infinity if empty.

  /// Returns whether the box has no point.
  bool empty() const;

  /// Returns whether min <= point <= max in each coordinate, compared exactly. False for an empty box and for
  /// a point with a coordinate that is not finite.
  bool contains(const Eigen::Vector3d& point) const;

  /// Returns the volume in cubed units; 0 for an empty or flat box.
  double volume() const;

  /// Returns the surface area in squared units. Both sides of a flat box count. 0 for an empty box.
  double surface_area() const;

  /// Returns the centre of the box. NaN if empty.
  Eigen::Vector3d center() const;

  /// Returns a corner that is farthest along `direction` (any length). NaN if empty.
  Eigen::Vector3d support(const Eigen::Vector3d& direction) const;

  /// Returns the distance from the point to the box; 0 if the point is inside. NaN if the point has a NaN
  /// coordinate, otherwise infinity if the box is empty or the point has an infinite coordinate.
  double distance(const Eigen::Vector3d& point) const;

  /// Returns the part of the ray `origin + t * direction`, t >= 0, inside the box; see RayInterval. The error
  /// of `enter` and `exit` is at most 2^-50 of their magnitude plus 2^-1021.
  std::optional<RayInterval> intersect(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

  /// Returns whether the boxes have a point in common, compared exactly. False if either box is empty.
  bool overlaps(const Aabb& other) const;

  /// Returns the eight corners. Bits 0, 1 and 2 of i stand for x, y and z. Corner i has the maximum of a
  /// coordinate if the bit is set, otherwise the minimum. The corners of an empty box are infinite and
  /// meaningless.
  std::array<Eigen::Vector3d, 8> corners() const;

  /// Returns the box itself.
  Aabb aabb() const { return *this; }

  /// Returns corners() and six quadrilaterals; an empty mesh for an empty box.
  Mesh mesh() const;

  /// Returns the axis-aligned box of the transformed box. The result contains the exact value of `transform *
  /// p` for every point p of this box. Each max is rounded up to the next double, and each min is rounded
  /// down. If a product is below 1e-289, the box may be larger by about 1e-307.
  Aabb transformed(const Eigen::Isometry3d& transform) const;

  /// Enlarges the box to contain the point. A point with a coordinate that is not finite is ignored.
  Aabb& extend(const Eigen::Vector3d& point);

  /// Enlarges the box to contain the other box. The result is exact, so merging is commutative and
  /// associative.
  Aabb& merge(const Aabb& other);

  /// Returns a float copy that encloses the box.
  FloatAabb cast_float() const;

 private:
  Eigen::Vector3d min_;
  Eigen::Vector3d max_;
};

/// Returns whether the boxes have equal min and max.
bool operator==(const Aabb& a, const Aabb& b);
inline bool operator!=(const Aabb& a, const Aabb& b) {
  return !(a == b);
}

}  // namespace pcl_bv
