// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Directions spread over the sphere, and the support points along directions.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "pcl_bv/numeric/exact_dot.h"

namespace pcl_bv::detail {

/// Returns the 49 directions with components 0, +-1 and +-2 of which none is a multiple of another. They are
/// the 13 directions of the cube and the types (0,1,2), (1,1,2) and (1,2,2) of Larsson 2008. Every direction
/// is within 15 degrees of one of the 49 or of its opposite.
std::vector<Direction> spread_directions();

/// Returns the points that have the minimum or the maximum projection along at least one of the directions,
/// in the order of `points`.
std::vector<Eigen::Vector3d> support_points_along(const std::vector<Eigen::Vector3d>& directions,
                                                  const std::vector<Eigen::Vector3d>& points);

}  // namespace pcl_bv::detail
