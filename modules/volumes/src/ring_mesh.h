// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "pcl_bv/volumes/mesh.h"

namespace pcl_bv::volumes_internal {

/// An axis and two unit vectors across it, right-handed.
struct Triad {
  explicit Triad(const Eigen::Vector3d& a) : axis(a) {
    Eigen::Index least = 0;
    a.cwiseAbs().minCoeff(&least);
    u = Eigen::Vector3d::Unit(least).cross(a).stableNormalized();
    v = a.cross(u);
  }
  Eigen::Vector3d axis, u, v;
};

struct Ring {
  Eigen::Vector3d center;
  double radius;
};

/// Rings of `sides` vertices each across the triad's axis, ascending along it; quadrilaterals between them, a
/// polygon at each end.
Mesh ring_mesh(const std::vector<Ring>& rings, const Triad& triad, int sides);

}  // namespace pcl_bv::volumes_internal
