// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "pcl_bv/volumes/aabb.h"
#include "pcl_bv/volumes/geometry.h"

namespace [[gnu::visibility("default")]] pcl_bv {

namespace detail {
struct PrismAccess;
}

/// An upright prism over a simple polygon, in the frame and unit of its points. Its footprint is the polygon.
///
/// Let u = axes.col(0) . p, v = axes.col(1) . p and h = axes.col(2) . p be the coordinates of a point p. The
/// prism is the closed set of all p with low <= h <= high whose (u, v) is inside the outline or on it. If the
/// outline is convex, this means for each edge from a corner a to the next corner b that
/// (b - a) x ((u, v) - a) >= 0. The stored doubles define this set without rounding. The axes are
/// right-handed and orthonormal to 1e-12; the third one is up.
///
/// The corners of the outline are counter-clockwise seen from above. No two corners are equal, no three that
/// follow each other are collinear, and edges meet only at the corner that they share. An outline of two
/// corners is a segment, an outline of one corner is a point. A flat prism is a valid volume. The empty prism
/// has no corners, low = infinity, high = -infinity and the coordinate axes. Coordinates beyond 1e100 are not
/// supported.
///
/// If the outline is not convex, functions of pairs (overlaps(), distance() of pair_queries.h), inflated
/// regions (region_mask.h) and trees of volumes use the prism over its convex hull. They report every
/// contact, and also contacts with the convex hull inside a bay, a region between the outline and its convex
/// hull. contains(), intersect(), distance() of a point, the measures and mesh() are those of the outline
/// itself.
class Prism {
 public:
  /// Makes the empty prism.
  Prism();

  /// Makes a prism. The columns of `axes` are the two axes of the plane and the direction up. An outline
  /// without corners, or low > high, gives the empty prism. Otherwise throws std::invalid_argument unless all
  /// numbers are finite, the corners at most 1e101 in magnitude, the axes are right-handed and orthonormal to
  /// 1e-12, and the outline is a polygon as described above, which is tested exactly. Stores -0 as 0.
  /// O(n log n) for a convex outline of n corners; otherwise O(n^2) at worst, and O(n log n) if few edges
  /// share a range of u.
  Prism(const Eigen::Matrix3d& axes, std::vector<Eigen::Vector2d> outline, double low, double high);

  const Eigen::Matrix3d& axes() const { return axes_; }                     ///< The axes as columns.
  Eigen::Vector3d up() const { return axes_.col(2); }                       ///< The third axis.
  const std::vector<Eigen::Vector2d>& outline() const { return outline_; }  ///< Corners (u, v).
  double low() const { return low_; }    ///< Smallest height; infinity if empty.
  double high() const { return high_; }  ///< Largest height; -infinity if empty.

  /// Returns whether the outline is convex. True for outlines of one or two corners and if empty. O(1).
  bool is_convex() const { return is_convex_; }

  /// Returns the area of the outline in squared units; 0 if empty.
  double footprint_area() const;

  /// Returns the corners of the outline at the height low(), in the frame of the points. They are rounded.
  std::vector<Eigen::Vector3d> footprint() const;

  /// Returns whether the prism has no point.
  bool empty() const { return outline_.empty(); }

  /// Returns whether the prism contains the point. Conservative: true for every point of the prism, in spite
  /// of rounding errors. False for an empty prism and for a point with a coordinate that is not finite or
  /// beyond 1e120. O(corners).
  ///
  /// Computed in double with error bounds. The bound of u, v and h is e = 4 * 2^-53 of the magnitudes of
  /// their three products, plus 2^-1022. The bound of the cross product of an edge (x, y) is
  /// |x| e_v + |y| e_u, plus 8 * 2^-53 of the magnitudes of its two products. Beyond a corner, a point can be
  /// treated as inside up to the bound divided by the sine of half the interior angle, but only if it is in
  /// the box of the outline, within e. A point is also treated as inside if it is within these bounds of an
  /// edge of an outline that is not convex.
  bool contains(const Eigen::Vector3d& point) const;

  double volume() const;        ///< Volume in cubed units; 0 if empty or flat. O(corners).
  double surface_area() const;  ///< Area in squared units; both sides of a flat prism count. 0 if empty.

  /// Returns the centre of mass or, if the prism is flat, of the polygon, segment or point. NaN if empty. The
  /// centre can be outside the outline if this is not convex.
  Eigen::Vector3d center() const;

  /// Returns a corner that is farthest along `direction` (any length). NaN if empty. O(corners).
  Eigen::Vector3d support(const Eigen::Vector3d& direction) const;

  /// Returns the distance from the point to the prism; 0 if contains() is true. NaN if the point has a NaN
  /// coordinate, otherwise infinity if the prism is empty or the point has an infinite coordinate.
  /// O(corners).
  double distance(const Eigen::Vector3d& point) const;

  /// Returns the part of the ray `origin + t * direction`, t >= 0, inside the prism; see RayInterval. If the
  /// outline is not convex, the ray can leave the prism and enter it again; the interval then extends from
  /// the first entry to the last exit. The coordinates of origin and direction are widened by twice the error
  /// bound of contains(). O(corners).
  std::optional<RayInterval> intersect(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

  /// Returns a box that contains every point of the prism, in spite of rounding errors. If the axes of the
  /// prism are parallel to the coordinate axes, the box is the smallest one. Otherwise it exceeds the
  /// smallest box by about 2^-48 of the size of the prism. O(corners).
  Aabb aabb() const;

  /// Returns the mesh of the prism: the corners at the height low, then those at the height high. The sides
  /// come first. If the outline is convex, the last two faces are bottom and top; otherwise these consist of
  /// triangles. A segment has only its two sides. A point has one face of two vertices. O(n) for a convex
  /// outline of n corners. Otherwise usually O(n^2), at worst O(n^3).
  Mesh mesh() const;

  /// Returns the transformed prism. The result contains the exact value of `transform * p` for every point p
  /// of this prism. The outline and the heights move outward by the rounding errors of the axes and of the
  /// coordinates. Where this leaves a sharp corner uncovered, the outline gets further corners, which are
  /// some rounding steps apart.
  ///
  /// An outline that is not convex usually stays so. In these cases the result is the prism over the convex
  /// hull: rounding could make two edges meet; rounding removes all bays; or one angle, inside or outside, is
  /// below 0.11 degrees. O(n log n) for a convex outline of n corners; otherwise O(n^2) at worst, and
  /// O(n log n) if few edges share a range of u.
  Prism transformed(const Eigen::Isometry3d& transform) const;

 private:
  friend detail::PrismAccess;

  Eigen::Matrix3d axes_;
  std::vector<Eigen::Vector2d> outline_;
  double low_, high_;
  bool is_convex_ = true;
};

/// Returns whether axes, outline and heights are equal, or both prisms are empty. Outlines that begin with
/// different corners are not equal.
bool operator==(const Prism& a, const Prism& b);
inline bool operator!=(const Prism& a, const Prism& b) {
  return !(a == b);
}

}  // namespace pcl_bv
