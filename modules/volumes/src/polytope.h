// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Convex polytopes as vertices and faces, with functions for their volume, area and centroid, and for the
// polytope of a k-DOP.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/volumes/kdop.h"

namespace pcl_bv::detail {

using Face = std::vector<std::int32_t>;

/// A convex polytope. A flat polytope has two faces that coincide; a segment has one face of two vertices; a
/// point has no face.
struct Polytope {
  Eigen::Vector3d origin;                 ///< Corners are vertices[i] + origin.
  std::vector<Eigen::Vector3d> vertices;  ///< Empty if the slabs have no point in common.
  std::vector<Face> faces;                ///< Counter-clockwise seen from outside.
  double volume = 0;
  /// The centroid relative to the origin. NaN if there are no vertices.
  Eigen::Vector3d centroid = Eigen::Vector3d::Constant(kNan);
};

/// The size and the first moment of a polytope.
struct Measure {
  double size = 0;  ///< Volume for rank 3, area of all faces for rank 2, 0 for rank 1 and 0.
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< Integral of the position over the polytope.

  /// Returns the centre of mass or, if the size is 0, the mean of the vertices.
  Eigen::Vector3d centroid(const std::vector<Eigen::Vector3d>& vertices) const;

  void add(double part, const Eigen::Vector3d& center) {
    size += part;
    moment += part * center;
  }
};

/// Measures a polytope of rank 3 by tetrahedra from the first vertex, and a polytope of rank 2 by triangles.
Measure measure(const std::vector<Eigen::Vector3d>& vertices, const std::vector<Face>& faces, int rank);

/// Returns the polytope of the k-DOP, which must not be empty.
Polytope intersect_slabs(const Kdop& kdop);

/// Returns the area of all faces.
double surface_area(const Polytope& polytope);

/// Returns the distance from the polytope to a point outside it. The point is relative to the origin of the
/// polytope.
double distance(const Polytope& polytope, const Eigen::Vector3d& point);

/// Returns the power of two, at least 2^-1000, that divides the largest coordinate into [1, 2); 1 if all
/// coordinates are 0.
double power_of_two_near(const std::vector<Eigen::Vector3d>& vertices);

}  // namespace pcl_bv::detail
