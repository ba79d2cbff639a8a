// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Directions all around, and the points that are farthest along some.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "pcl_bv/numeric/exact_dot.h"

namespace pcl_bv {

/// Components 0, +-1, +-2, none a multiple of another: 49, no direction farther than 15 degrees from one of
/// them. The 13 of the cube and the types (0,1,2), (1,1,2) and (1,2,2) of Larsson 2008.
std::vector<Direction> scattered_directions();

/// Those of the points, in their order, that are farthest along one of the directions or opposite to it.
std::vector<Eigen::Vector3d> farthest_along(const std::vector<Eigen::Vector3d>& directions,
                                            const std::vector<Eigen::Vector3d>& points);

}  // namespace pcl_bv
