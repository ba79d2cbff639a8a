// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "pcl_bv/volumes/aabb.h"
#include "pcl_bv/volumes/mesh.h"
#include "pcl_bv/volumes/ray_interval.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// The half-space normal . p <= offset. The normal has length 1 up to rounding and points outward.
struct HullPlane {
  Eigen::Vector3d normal;
  double offset;
};

/// A convex hull in the frame and unit of its points: all p with normal . p <= offset for each plane, a
/// closed set.
///
/// Two descriptions of one body. The planes are what encloses: contains(), intersect(), aabb() and the proof
/// of a fit go by them; those of a fitted hull are of its faces and of its box. The vertices and the triangles
/// between them are what is measured: volume(), center(), support(), distance(). They agree to the rounding
/// of doubles.
///
/// A flat hull has a rank below 3 and no triangles: its vertices are the corners of a polygon (2, in order
/// around it), the ends of a line (1) or a point (0), its planes come in opposite pairs along each flat
/// direction. The empty hull has rank 0 and neither vertices nor planes. Coordinates beyond 1e100 are not
/// supported.
class Hull {
 public:
  using Triangle = std::array<std::int32_t, 3>;

  /// The empty hull.
  Hull() = default;

  /// Planes should enclose the vertices, and triangles be counter-clockwise seen from outside; that is not
  /// checked. Throws std::invalid_argument for numbers that are not finite, a rank that is not 0 to 3, a
  /// triangle with a number that names no vertex, and unless there are vertices and planes (or neither). A -0
  /// is stored as 0.
  Hull(std::vector<Eigen::Vector3d> vertices, std::vector<Triangle> triangles, std::vector<HullPlane> planes,
       int rank);

  const std::vector<Eigen::Vector3d>& vertices() const { return vertices_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  const std::vector<HullPlane>& planes() const { return planes_; }
  int rank() const { return rank_; }

  bool empty() const { return planes_.empty(); }

  /// For each plane: s = (x nx + y ny) + z nz is at most the offset, give or take the rounding bound
  /// 4 2^-53 (|x nx| + |y ny| + |z nz|) + 2^-1022. So every point inside by exact arithmetic is contained; it
  /// errs only towards true. False for an empty hull and for a point that is not finite. O(planes).
  bool contains(const Eigen::Vector3d& point) const;

  double volume() const;        ///< In cubed units; 0 if empty or flat. O(triangles).
  double surface_area() const;  ///< In squared units; both sides of a flat hull count. 0 if empty.

  /// The centre of mass (of the area, the line, the point if flat). NaN if empty.
  Eigen::Vector3d center() const;

  /// The vertex farthest along `direction` (any length), the first of several. NaN if empty. O(vertices).
  Eigen::Vector3d support(const Eigen::Vector3d& direction) const;

  /// Distance of a point to the nearest triangle, 0 where contains() holds. Infinity if empty, NaN for a
  /// point with a NaN. O(triangles).
  double distance(const Eigen::Vector3d& point) const;

  /// Where the ray origin + t direction is inside, as RayInterval says. Each projection, of origin and
  /// direction, is taken to be off by twice the bound of contains().
  std::optional<RayInterval> intersect(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

  /// A box around the hull, by exact arithmetic. A side that a plane of the hull lies in ends there, as all six do
  /// of a fitted hull, whose box is that of its points; other sides end at a proven upper bound. Planes that
  /// bound no body, which no fit and no transformed() makes, give the box of the vertices. O(planes).
  Aabb aabb() const;

  /// Vertices and triangles; a flat hull gives its polygon twice, once for each side.
  Mesh mesh() const;

  /// The moved hull. Each plane moves outward by the rounding of its normal, so that the image of every point
  /// inside, by exact arithmetic on the stored matrix, is inside. (Where planes bound no body: of every point
  /// in aabb().) O(planes).
  Hull transformed(const Eigen::Isometry3d& transform) const;

 private:
  std::vector<Eigen::Vector3d> vertices_;
  std::vector<Triangle> triangles_;
  std::vector<HullPlane> planes_;
  int rank_ = 0;
};

/// The same numbers.
bool operator==(const Hull& a, const Hull& b);
inline bool operator!=(const Hull& a, const Hull& b) {
  return !(a == b);
}

}  // namespace pcl_bv
