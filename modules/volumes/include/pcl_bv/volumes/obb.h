// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <optional>

#include "pcl_bv/volumes/aabb.h"
#include "pcl_bv/volumes/mesh.h"
#include "pcl_bv/volumes/ray_interval.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// A copy of an Obb for float consumers: |axes.col(i) . (p - center)| <= half_extents[i] with these numbers
/// holds for every point of the box. Beyond the range of float: infinite. Empty: centre NaN, half extents -1.
struct FloatObb {
  Eigen::Vector3f center;
  Eigen::Matrix3f axes;
  Eigen::Vector3f half_extents;
};

/// A box with axes of its own, in the frame and unit of its points: all p with
/// |axis(i) . (p - center)| <= half_extents[i] for i = 0, 1, 2, by exact arithmetic on the stored doubles; a
/// closed set. The axes are unit and orthogonal to 1e-12 and right-handed.
///
/// The empty box has half extents -1, centre NaN and the coordinate axes. Half extents of 0 are flat boxes,
/// volumes like any other. Coordinates beyond 1e100 are not supported.
class Obb {
 public:
  /// The empty box.
  Obb();

  /// Axes are the columns. If they are left-handed, the last one is turned round, which is the same box. Any
  /// negative half extent: the empty box. Otherwise throws std::invalid_argument unless all numbers are
  /// finite and the axes unit and orthogonal to 1e-12. A -0 is stored as 0. The order of the axes is kept;
  /// see canonical().
  Obb(const Eigen::Vector3d& center, const Eigen::Matrix3d& axes, const Eigen::Vector3d& half_extents);

  /// The box with this pose: the way back from pose().
  Obb(const Eigen::Isometry3d& pose, const Eigen::Vector3d& half_extents)
      : Obb(pose.translation(), pose.linear(), half_extents) {}

  /// The same box with the coordinate axes; encloses it by exact arithmetic.
  explicit Obb(const Aabb& box);

  /// The box around all p with low[i] <= axes.col(i) . p <= high[i], by exact arithmetic; its half extents
  /// exceed (high - low) / 2 by the rounding of the centre. Any low above its high: empty. Throws as the
  /// constructor does.
  static Obb from_slabs(const Eigen::Matrix3d& axes, const Eigen::Vector3d& low, const Eigen::Vector3d& high);

  /// The same with low[i] <= axes.col(i) . (p - origin) <= high[i]: tighter far from the frame's origin.
  static Obb from_slabs(const Eigen::Matrix3d& axes, const Eigen::Vector3d& origin,
                        const Eigen::Vector3d& low, const Eigen::Vector3d& high);

  const Eigen::Vector3d& center() const { return center_; }
  const Eigen::Matrix3d& axes() const { return axes_; }                  ///< In columns.
  Eigen::Vector3d axis(int i) const { return axes_.col(i); }             ///< i is 0, 1 or 2.
  const Eigen::Vector3d& half_extents() const { return half_extents_; }  ///< Half the size along each axis.

  /// From the box's own coordinates, in which it is |x|, |y|, |z| <= half_extents, to the frame of its
  /// points. An empty box's translation is NaN.
  Eigen::Isometry3d pose() const;

  /// The rotation of pose(): unit to 1e-15, the first of w, x, y, z that is not 0 is positive.
  Eigen::Quaterniond quaternion() const;

  bool empty() const { return half_extents_.x() < 0; }

  /// With q = point - center and s = axis . q in double: |s| <= half extent + 8 2^-53 |q|_1 + 2^-1022, for
  /// each axis. So every point inside by exact arithmetic is contained; it errs only towards true. False for
  /// an empty box and for a point that is not finite.
  bool contains(const Eigen::Vector3d& point) const;

  double volume() const;        ///< In cubed units; 0 if empty or flat.
  double surface_area() const;  ///< In squared units; both sides of a flat box count. 0 if empty.

  /// A corner farthest along `direction` (any length). NaN if empty.
  Eigen::Vector3d support(const Eigen::Vector3d& direction) const;

  /// Distance of a point, 0 where contains() holds. Infinity if empty, NaN for a point with a NaN.
  double distance(const Eigen::Vector3d& point) const;

  /// Where the ray origin + t direction is inside, as RayInterval says; where contains() holds for the
  /// origin, enter is 0. Projections of origin and direction are taken to be off by twice the bound of
  /// contains(), so a ray that passes a face by less may hit; then each end is moved outward by 2^-51 of
  /// itself and by 2^-1022.
  std::optional<RayInterval> intersect(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

  /// Whether the two have a point in common: separating axes (Gottschalk et al. 1996), a gap of 4e-12 of the
  /// sizes and the distance counting as none. So it errs only towards true. False if either is empty.
  bool overlaps(const Obb& other) const;

  /// The eight corners, rounded: corner i is on the positive side of axis 0 where bit 0 of i is set, of axis
  /// 1 for bit 1, of axis 2 for bit 2. NaN if empty.
  std::array<Eigen::Vector3d, 8> corners() const;

  /// A box around the box by exact arithmetic, tight to a few units in the last place.
  Aabb aabb() const;

  /// corners() and six quadrilaterals; nothing for an empty box.
  Mesh mesh() const;

  /// The moved box: the image of every point of this one, by exact arithmetic on the stored matrix, is
  /// inside. Half extents grow by the rounding of axes and centre and by what the matrix stretches.
  Obb transformed(const Eigen::Isometry3d& transform) const;

  /// A box around both, by exact arithmetic: of those along the axes of this one, of the other and of the
  /// frame the one with the least volume (the least area, where flat). If one of the two holds the other by a
  /// margin above rounding it is the result, unchanged. Boxes with the same third axis, as upright ones have,
  /// give one with that third axis, upright(). Commutative; not the smallest box there is.
  Obb merged(const Obb& other) const;

  /// The same box, its axes in a standard order and direction, so that noise does not turn it: half extents
  /// descend, those that agree to 2^-40 in the order of their axes (the one most along x first); axes 0 and 1
  /// point where their largest component is positive. A fit's boxes are canonical, those of upright methods
  /// upright().
  Obb canonical() const;

  /// The same box, its axes in the order and direction of every upright method: axis 2 is the one nearest to
  /// `up` (any length from 1e-100 to 1e100) and points up, axis 0 is the longer of the other two and has a
  /// yaw() from -pi/2 (exclusive) to pi/2, axis 1 makes them right-handed. Where the two agree to 2^-40, axis
  /// 0 is the one with the smaller yaw (at 45 degrees: the positive one). Components below 1e-9 are treated
  /// as 0, so that noise turns no box round. An empty box stays empty.
  Obb upright(const Eigen::Vector3d& up) const;

  /// The rotation of axis 0 about axis 2 in radians, from -pi (exclusive) to pi: 0 where axis 0, seen along
  /// axis 2, points along x (along y, where axis 2 is less than 45 degrees from the x axis). With z up the
  /// yaw of robotics: counter-clockwise from x. NaN if empty.
  double yaw() const;

  /// The same box, its axes named so that it is turned least from `previous`, of the 24 ways: what a tracker
  /// needs whose box must not flip. Unchanged if either is empty.
  Obb oriented_as(const Obb& previous) const;

  FloatObb cast_float() const;

 private:
  double reach_up(const Eigen::Vector3d& direction) const;  // greatest direction . (p - center), rounded up
  bool surely_holds(const Obb& other) const;

  Eigen::Vector3d center_;
  Eigen::Matrix3d axes_;
  Eigen::Vector3d half_extents_;
};

/// The same numbers, or both empty.
bool operator==(const Obb& a, const Obb& b);
inline bool operator!=(const Obb& a, const Obb& b) {
  return !(a == b);
}

/// The right-handed axes nearest, in the order of the columns, to the given ones: column 0 normalised, what
/// column 1 adds to it normalised, and their cross product; unit and orthogonal to 1e-15. Columns 0 and 1
/// must be finite and not parallel; magnitudes from 1e-100 to 1e100.
Eigen::Matrix3d orthonormal_axes(const Eigen::Matrix3d& axes);

}  // namespace pcl_bv
