// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include "pcl_bv/volumes/mesh.h"
#include "triad.h"

namespace pcl_bv::volumes_internal {

struct Ring {
  Eigen::Vector3d center;
  double radius;
};

/// Rings of `sides` vertices each across the triad's axis, ascending along it; quadrilaterals between them, a
/// polygon at each end.
Mesh ring_mesh(const std::vector<Ring>& rings, const Triad& triad, int sides);

}  // namespace pcl_bv::volumes_internal
