// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Bodies as corners and faces: how they are measured, and those of a k-DOP.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "pcl_bv/volumes/kdop.h"

namespace pcl_bv::volumes_internal {

using Face = std::vector<std::int32_t>;

/// A convex polytope, which may be flat: two faces that coincide, a line: one face of two vertices, a point:
/// none.
struct Polytope {
  Eigen::Vector3d origin;                 ///< Corners are vertices[i] + origin.
  std::vector<Eigen::Vector3d> vertices;  ///< Empty if the slabs have no common point.
  std::vector<Face> faces;                ///< Counter-clockwise from outside.
  double volume = 0;
  Eigen::Vector3d centroid;  ///< Relative to the origin.
};

/// How much there is, and where.
struct Measure {
  double size = 0;  ///< Volume, area or length by rank.
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();

  /// Where it balances; if there is none of it, the mean of the vertices that it is of.
  Eigen::Vector3d centroid(const std::vector<Eigen::Vector3d>& vertices) const;

  void add(double part, const Eigen::Vector3d& center) {
    size += part;
    moment += part * center;
  }
};

/// Of rank 3 by tetrahedra from the first vertex, of rank 2 by triangles.
Measure measure(const std::vector<Eigen::Vector3d>& vertices, const std::vector<Face>& faces, int rank);

/// For a k-DOP that is not empty.
Polytope intersect_slabs(const Kdop& kdop);

/// Of all faces.
double surface_area(const Polytope& polytope);

/// From a point (relative to the origin) outside the polytope.
double distance(const Polytope& polytope, const Eigen::Vector3d& point);

}  // namespace pcl_bv::volumes_internal
