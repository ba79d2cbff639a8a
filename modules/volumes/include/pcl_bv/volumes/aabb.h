// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <optional>

#include "pcl_bv/volumes/mesh.h"
#include "pcl_bv/volumes/ray_interval.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// A copy of an Aabb for float consumers, rounded outward: it encloses the box. Beyond the range of float:
/// infinite.
struct FloatAabb {
  Eigen::Vector3f min;
  Eigen::Vector3f max;
};

/// An axis-aligned box in the frame and unit of its points: min <= p <= max in each coordinate, a closed set.
///
/// The empty box (the identity of merge) has min = +infinity and max = -infinity. Flat boxes (min equal to
/// max along one, two or all three axes) are volumes like any other. Coordinates beyond 1e100 overflow in
/// volume() and the like.
class Aabb {
 public:
  /// The empty box.
  Aabb();

  /// The box between two corners. Any min above its max: the empty box. Otherwise all six must be finite, or
  /// std::invalid_argument. A -0 is stored as 0.
  Aabb(const Eigen::Vector3d& min, const Eigen::Vector3d& max);

  const Eigen::Vector3d& min() const { return min_; }
  const Eigen::Vector3d& max() const { return max_; }

  bool empty() const;

  /// Exact comparison: min <= point <= max. False for an empty box and for a point that is not finite.
  bool contains(const Eigen::Vector3d& point) const;

  /// In cubed units; 0 for an empty or a flat box.
  double volume() const;

  /// In squared units; both sides of a flat box count. 0 for an empty box.
  double surface_area() const;

  /// The centre of mass. NaN for an empty box.
  Eigen::Vector3d center() const;

  /// A corner of the box farthest along `direction` (any length). NaN for an empty box.
  Eigen::Vector3d support(const Eigen::Vector3d& direction) const;

  /// Distance of a point to the box, 0 inside. Infinity for an empty box, NaN for a point with a NaN.
  double distance(const Eigen::Vector3d& point) const;

  /// Where the ray origin + t direction is inside, as RayInterval says. Each end is off by no more than 2^-50
  /// of itself, plus 2^-1021.
  std::optional<RayInterval> intersect(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

  /// Whether the two have a point in common: exact comparison. False if either is empty.
  bool overlaps(const Aabb& other) const;

  /// The eight corners: corner i has max x where bit 0 of i is set, max y for bit 1, max z for bit 2. Those
  /// of an empty box are meaningless (infinite).
  std::array<Eigen::Vector3d, 8> corners() const;

  Aabb aabb() const { return *this; }

  /// corners() and six quadrilaterals; nothing for an empty box.
  Mesh mesh() const;

  /// The box of the moved box: the image of every point of this box, by exact arithmetic on the stored
  /// matrix, is inside; each side is the smallest double (greatest, for min) that does so, unless a product
  /// is below 1e-289, where some 1e-307 is added.
  Aabb transformed(const Eigen::Isometry3d& transform) const;

  /// Grows to hold the point. A point with a coordinate that is not finite is ignored.
  Aabb& extend(const Eigen::Vector3d& point);

  /// Grows to hold the other box: exact, commutative and associative.
  Aabb& merge(const Aabb& other);

  FloatAabb cast_float() const;

 private:
  Eigen::Vector3d min_;
  Eigen::Vector3d max_;
};

/// The same numbers.
bool operator==(const Aabb& a, const Aabb& b);
inline bool operator!=(const Aabb& a, const Aabb& b) {
  return !(a == b);
}

}  // namespace pcl_bv
