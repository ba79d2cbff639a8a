// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The corners and faces of a k-DOP by intersection of its half-spaces.
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

/// For a k-DOP that is not empty.
Polytope intersect_slabs(const Kdop& kdop);

/// Of all faces.
double surface_area(const Polytope& polytope);

/// From a point (relative to the origin) outside the polytope.
double distance(const Polytope& polytope, const Eigen::Vector3d& point);

}  // namespace pcl_bv::volumes_internal
