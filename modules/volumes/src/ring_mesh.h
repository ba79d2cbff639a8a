// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Meshes made of parallel rings of vertices, for cylinders, capsules and ellipsoids.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "pcl_bv/volumes/geometry.h"

namespace pcl_bv::detail {

/// An axis and two unit vectors perpendicular to it, right-handed.
struct Triad {
  explicit Triad(const Eigen::Vector3d& a) : axis(a) {
    Eigen::Index smallest = 0;
    a.cwiseAbs().minCoeff(&smallest);
    u = Eigen::Vector3d::Unit(smallest).cross(a).stableNormalized();
    v = a.cross(u);
  }
  Eigen::Vector3d axis, u, v;
};

struct Ring {
  Eigen::Vector3d center;
  double radius;
};

/// Returns a mesh of rings of `sides` vertices each, perpendicular to the triad's axis and in ascending order
/// along this axis. There are quadrilaterals between neighbouring rings and a polygon at each end.
Mesh ring_mesh(const std::vector<Ring>& rings, const Triad& triad, int sides);

}  // namespace pcl_bv::detail
