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
#include "pcl_bv/volumes/geometry.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// The half-space normal . p <= offset. The normal points outward and has length 1 up to rounding.
struct HullPlane {
  Eigen::Vector3d normal;
  double offset;
};

/// A convex hull in the frame and unit of its points: the closed set of all p with normal . p <= offset for
/// each plane.
///
/// A hull has two descriptions, which agree up to the rounding of doubles. The planes define the enclosed
/// set. contains(), intersect(), aabb() and the proof of a fit use the planes. The vertices and triangles
/// define the surface. volume(), surface_area(), center(), support() and distance() use the vertices and
/// triangles. A fitted hull has the planes of its faces and the six planes of its axis-aligned box.
///
/// A flat hull has a rank below 3 and no triangles. The vertices are the corners of a polygon in order (rank
/// 2), the ends of a segment (rank 1) or a point (rank 0). For each direction in which the hull is flat, two
/// of its planes face opposite ways. The empty hull has rank 0 and neither vertices nor planes. Coordinates
/// beyond 1e100 are not supported.
class Hull {
 public:
  using Triangle = std::array<std::int32_t, 3>;  ///< Indices of three vertices.

  /// Makes the empty hull.
  Hull() = default;

  /// Makes a hull. The planes should enclose the vertices, and the triangles should be counter-clockwise seen
  /// from outside; neither is checked. Throws std::invalid_argument for numbers that are not finite, a rank
  /// outside 0 to 3, a triangle with an index outside the vertices, vertices without planes, or planes
  /// without vertices. Stores -0 as 0.
  Hull(std::vector<Eigen::Vector3d> vertices, std::vector<Triangle> triangles, std::vector<HullPlane> planes,
       int rank);

  const std::vector<Eigen::Vector3d>& vertices() const { return vertices_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  const std::vector<HullPlane>& planes() const { return planes_; }
  int rank() const { return rank_; }  ///< Number of dimensions that the vertices span.

  /// Returns whether this is the empty hull, without planes.
  bool empty() const { return planes_.empty(); }

  /// Returns whether the hull contains the point. Conservative: true for every point of the hull, in spite of
  /// rounding errors. False for an empty hull and for a point with a coordinate that is not finite.
  /// O(planes).
  ///
  /// Computed in double, with s = (x nx + y ny) + z nz. The condition for each plane is s - e <= offset,
  /// where e = 4 * 2^-53 (|x nx| + |y ny| + |z nz|) + 2^-1022 is the error bound.
  bool contains(const Eigen::Vector3d& point) const;

  double volume() const;        ///< Volume in cubed units; 0 if empty or flat. O(triangles).
  double surface_area() const;  ///< Area in squared units; both sides of a flat hull count. 0 if empty.

  /// Returns the centre of mass of the hull or, if it is flat, of the polygon, segment or point. NaN if
  /// empty.
  Eigen::Vector3d center() const;

  /// Returns the vertex that is farthest along `direction` (any length). If several vertices are equally far,
  /// returns the first. NaN if empty. O(vertices).
  Eigen::Vector3d support(const Eigen::Vector3d& direction) const;

  /// Returns the distance from the point to the nearest triangle or, if the hull is flat, to its polygon,
  /// segment or point. 0 if contains() is true. NaN if the point has a NaN coordinate, otherwise infinity if
  /// the hull is empty or the point has an infinite coordinate. O(triangles).
  double distance(const Eigen::Vector3d& point) const;

  /// Returns the part of the ray `origin + t * direction`, t >= 0, inside the hull; see RayInterval. The
  /// projections of origin and direction are widened by twice the error bound of contains(). O(planes).
  std::optional<RayInterval> intersect(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

  /// Returns a box that contains every point of the hull, in spite of rounding errors. If the hull has a
  /// plane that faces the same way as a side of the box, the side lies in that plane. Other sides are at a
  /// proven upper bound of the hull's support value. A fitted hull has planes for all six sides, so its box
  /// is the box of its points. If the planes leave the hull unbounded, the result is the box of the vertices.
  /// A fitted hull is never unbounded, nor is its transformed() copy. O(planes).
  Aabb aabb() const;

  /// Returns vertices and triangles. The mesh of a hull of rank 2 has its polygon twice, once for each side.
  Mesh mesh() const;

  /// Returns the transformed hull. The result contains the exact value of `transform * p` for every point p
  /// of this hull. Each plane moves outward by the rounding error of its normal. If the planes leave the hull
  /// unbounded, the result is guaranteed to contain only the points p of aabb(), transformed. O(planes).
  Hull transformed(const Eigen::Isometry3d& transform) const;

 private:
  std::vector<Eigen::Vector3d> vertices_;
  std::vector<Triangle> triangles_;
  std::vector<HullPlane> planes_;
  int rank_ = 0;
};

/// Returns whether vertices, triangles, planes and rank are equal.
bool operator==(const Hull& a, const Hull& b);
inline bool operator!=(const Hull& a, const Hull& b) {
  return !(a == b);
}

/// Returns the view frustum of a camera, a pyramid cut off by two planes, as a hull of 8 vertices, 12
/// triangles and 6 planes. The result can be used like any other Hull.
///
/// `pose` is the transform from the camera's frame to the frame of the points. The camera is at the origin of
/// its frame; z is its viewing direction, x is to the right and y is down. This is the optical frame of ROS.
/// In the frame of pcl::FrustumCulling, in contrast, x is forward. In the camera's frame, the frustum is near
/// <= z <= far, |x| <= z horizontal_tan and |y| <= z vertical_tan. `horizontal_tan` and `vertical_tan` are
/// the tangents of half the fields of view. For a pinhole camera, horizontal_tan is (columns / 2) / fx.
///
/// Vertex i is at `far` if bit 2 of i is set, at positive x if bit 0 is set and at positive y if bit 1 is
/// set. The planes are near, far, positive x, negative x, positive y, negative y. Vertices are rounded. Each
/// plane is then moved outward, so that all rounded vertices lie exactly on its inner side or on it.
///
/// If `near` is 0, the frustum is a complete pyramid, with four vertices at the camera. Throws
/// std::invalid_argument unless 0 <= near < far <= 1e100 and both tangents are above 0 and at most 1e6. Also
/// throws unless each coordinate of the pose's translation is from -1e100 to 1e100 and the axes of the pose
/// are right-handed and orthonormal to 1e-6.
Hull frustum(const Eigen::Isometry3d& pose, double near, double far, double horizontal_tan,
             double vertical_tan);

}  // namespace pcl_bv
