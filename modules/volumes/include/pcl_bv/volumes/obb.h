// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <optional>

#include "pcl_bv/volumes/aabb.h"
#include "pcl_bv/volumes/geometry.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// A float copy of an Obb that encloses the Obb: every point p of the Obb satisfies |axes.col(i) . (p -
/// center)| <= half_extents[i], where axes, center and half_extents are members of the FloatObb. Half extents
/// beyond the range of float are infinite. An empty box has centre NaN and half extents -1.
struct FloatObb {
  Eigen::Vector3f center;
  Eigen::Matrix3f axes;
  Eigen::Vector3f half_extents;
};

/// An oriented box in the frame and unit of its points: the closed set of all p with |axis(i) . (p - center)|
/// <= half_extents[i] for i = 0, 1, 2. The stored doubles define this set without rounding. The axes are
/// right-handed and orthonormal to 1e-12.
///
/// The empty box has half extents -1, centre NaN and the coordinate axes. A box with a half extent of 0 is
/// flat and a valid volume. Coordinates beyond 1e100 are not supported.
class Obb {
 public:
  /// Makes the empty box.
  Obb();

  /// Makes a box. The axes are the columns of `axes`, in this order. If the axes are left-handed, the last
  /// axis is negated, which gives the same box. Any negative half extent gives the empty box. Otherwise
  /// throws std::invalid_argument unless all numbers are finite and the axes are orthonormal to 1e-12. Stores
  /// -0 as 0.
  Obb(const Eigen::Vector3d& center, const Eigen::Matrix3d& axes, const Eigen::Vector3d& half_extents);

  /// Makes the box whose pose() and half_extents() are the arguments. Throws as the constructor above.
  Obb(const Eigen::Isometry3d& pose, const Eigen::Vector3d& half_extents)
      : Obb(pose.translation(), pose.linear(), half_extents) {}

  /// Makes a box along the coordinate axes that contains every point of `box`, in spite of rounding errors.
  explicit Obb(const Aabb& box);

  /// Returns a box that contains all p with low[i] <= axes.col(i) . p <= high[i], in spite of rounding
  /// errors. The half extents of the result exceed (high - low) / 2 by the rounding error of the centre. If
  /// any low exceeds its high, the box is empty. Throws as the constructor does.
  static Obb from_slabs(const Eigen::Matrix3d& axes, const Eigen::Vector3d& low, const Eigen::Vector3d& high);

  /// Returns a box that encloses all p with low[i] <= axes.col(i) . (p - origin) <= high[i]. For a box far
  /// from the origin of the frame, an `origin` near the box makes the result tighter.
  static Obb from_slabs(const Eigen::Matrix3d& axes, const Eigen::Vector3d& origin,
                        const Eigen::Vector3d& low, const Eigen::Vector3d& high);

  const Eigen::Vector3d& center() const { return center_; }              ///< Centre; NaN if empty.
  const Eigen::Matrix3d& axes() const { return axes_; }                  ///< The axes as columns.
  Eigen::Vector3d axis(int i) const { return axes_.col(i); }             ///< Axis i, where i is 0, 1 or 2.
  const Eigen::Vector3d& half_extents() const { return half_extents_; }  ///< Half the size along each axis.

  /// Returns the transform from the frame of the box to the frame of its points. In the frame of the box, the
  /// box is the set |x| <= half_extents[0], |y| <= half_extents[1], |z| <= half_extents[2]. The translation
  /// of an empty box is NaN.
  Eigen::Isometry3d pose() const;

  /// Returns the rotation of pose(). The norm of the quaternion differs from 1 by at most 1e-15. The first
  /// non-zero number of w, x, y, z is positive.
  Eigen::Quaterniond quaternion() const;

  /// Returns whether the box has no point.
  bool empty() const { return half_extents_.x() < 0; }

  /// Returns whether the box contains the point. Conservative: true for every point of the box, in spite of
  /// rounding errors. False for an empty box and for a point with a coordinate that is not finite.
  ///
  /// Computed in double, with q = point - center and s = axis . q. The condition for each axis is |s| <= half
  /// extent + 8 * 2^-53 |q|_1 + 2^-1022.
  bool contains(const Eigen::Vector3d& point) const;

  double volume() const;        ///< Volume in cubed units; 0 if empty or flat.
  double surface_area() const;  ///< Area in squared units; both sides of a flat box count. 0 if empty.

  /// Returns a corner that is farthest along `direction` (any length). NaN if empty.
  Eigen::Vector3d support(const Eigen::Vector3d& direction) const;

  /// Returns the distance from the point to the box; 0 if contains() is true. NaN if the point has a NaN
  /// coordinate, otherwise infinity if the box is empty or the point has an infinite coordinate.
  double distance(const Eigen::Vector3d& point) const;

  /// Returns the part of the ray `origin + t * direction`, t >= 0, inside the box; see RayInterval. `enter`
  /// is 0 if contains() is true for the origin.
  ///
  /// The projections of origin and direction are widened by twice the error bound of contains(). So a ray
  /// that misses a face by less than these error bounds may be reported as a hit. Finally, `enter` and `exit`
  /// are moved outward by 2^-51 of their magnitude plus 2^-1022.
  std::optional<RayInterval> intersect(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

  /// Returns whether the boxes have a point in common. Conservative: true for all boxes that overlap, in
  /// spite of rounding errors. False if either box is empty. Uses the separating axis test (Gottschalk et al.
  /// 1996). Let S be the sum of all half extents and of |c2 - c1|_1, where c1 and c2 are the centres. A gap
  /// of at most 4e-12 S is ignored.
  bool overlaps(const Obb& other) const;

  /// Returns the eight corners, rounded. Corner i is on the positive side of axis 0 if bit 0 of i is set, of
  /// axis 1 if bit 1 is set and of axis 2 if bit 2 is set. NaN if empty.
  std::array<Eigen::Vector3d, 8> corners() const;

  /// Returns an axis-aligned box that contains every point of this box, in spite of rounding errors. The
  /// result is tight to a few units in the last place.
  Aabb aabb() const;

  /// Returns corners() and six quadrilaterals; an empty mesh for an empty box.
  Mesh mesh() const;

  /// Returns the transformed box. The result contains the exact value of `transform * p` for every point p of
  /// this box. Half extents grow by the rounding errors of axes and centre, and by the error of the matrix,
  /// which is rarely exactly orthonormal.
  Obb transformed(const Eigen::Isometry3d& transform) const;

  /// Returns a box that contains every point of both boxes, in spite of rounding errors. There are three
  /// candidates: one with the axes of this box, one with the axes of the other box and one with the
  /// coordinate axes. The result is the candidate with the smallest volume. If volumes are equal, for example
  /// 0, the result is the candidate with the smallest surface area. If one box encloses the other by more
  /// than rounding errors, the result is the enclosing box, unchanged. If both boxes have exactly the same
  /// third axis, as upright boxes have, the third candidate has this third axis instead of the coordinate
  /// axes. The axes of the result are then ordered as by upright(). The order of the two boxes does not
  /// change the result. In general, the result is not the minimum-volume box.
  Obb merged(const Obb& other) const;

  /// Returns the same box with its axes in a standard order and direction, so that rounding noise does not
  /// reorder them. The half extents are in descending order. Half extents are treated as equal if they differ
  /// by at most 2^-40 of the largest half extent plus 2^-50 of the largest centre coordinate. Axes with equal
  /// half extents are ordered by the magnitude of the x components, largest first, then by y and z. The
  /// largest component of axis 0 is positive, and so is that of axis 1. Axis 2 makes the axes right-handed.
  /// Fits return canonical() boxes, except for the upright methods, which return upright() boxes.
  Obb canonical() const;

  /// Returns the same box with its axes in the order and direction that all upright methods use. Axis 2 is
  /// the axis nearest to the direction `up` and points up; `up` may have any length from 1e-100 to 1e100.
  /// Axis 0 is along the longer of the other two sides, with a yaw() from -pi/2 (exclusive) to pi/2. Axis 1
  /// makes the axes right-handed. If the horizontal half extents are treated as equal, as in canonical(),
  /// axis 0 is the axis whose yaw has the smaller magnitude. At 45 degrees, axis 0 is the axis with the
  /// positive yaw. Components of axes that differ by at most 1e-9 are treated as equal, so that rounding
  /// noise does not flip an axis. An empty box stays empty.
  Obb upright(const Eigen::Vector3d& up) const;

  /// Returns the rotation of axis 0 about axis 2 in radians, from -pi (exclusive) to pi. With axis 2 along z,
  /// this is the yaw of robotics, counter-clockwise from x. In general, x is projected on the plane
  /// perpendicular to axis 2, and the yaw is the angle from this projection to axis 0. If the line of axis 2
  /// is less than 45 degrees from the x axis, y replaces x. NaN if empty.
  double yaw() const;

  /// Returns the same box with its axes reordered and negated such that the rotation from `previous` is the
  /// smallest of the 24 possible rotations. Trackers call this function so that a box does not flip between
  /// frames. If either box is empty, returns this box unchanged.
  Obb oriented_as(const Obb& previous) const;

  /// Returns a float copy that encloses the box.
  FloatObb cast_float() const;

 private:
  double support_value_up(const Eigen::Vector3d& direction) const;  // upper bound of direction . (p - center)
  bool certainly_contains(const Obb& other) const;  // true only if the other box is proven inside

  Eigen::Vector3d center_;
  Eigen::Matrix3d axes_;
  Eigen::Vector3d half_extents_;
};

/// Returns whether centre, axes and half extents are equal, or both boxes are empty.
bool operator==(const Obb& a, const Obb& b);
inline bool operator!=(const Obb& a, const Obb& b) {
  return !(a == b);
}

/// Returns right-handed axes that are orthonormal to 1e-15, by the Gram-Schmidt process. Column 0 of the
/// result is the normalised column 0. Column 1 is the normalised part of column 1 that is perpendicular to
/// column 0. Column 2 is the cross product of columns 0 and 1. Column 2 of the argument is ignored. Columns 0
/// and 1 of the argument must be finite and not parallel, with lengths from 1e-100 to 1e100.
Eigen::Matrix3d orthonormal_axes(const Eigen::Matrix3d& axes);

}  // namespace pcl_bv
