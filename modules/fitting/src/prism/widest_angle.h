// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The point of a grid at which an edge subtends the largest angle.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "prism/planar_grid.h"

namespace pcl_bv::detail {

/// Returns the point to the left of the edge from a to b, or on it, at which the edge subtends the largest
/// angle. Of equal angles, the point with the smaller (u, v) is taken. Points with `is_corner` are not
/// considered. Returns nothing if there is no such point. The angles are rounded. The circle through a, b and
/// the point has no other point to the left of the edge that is not yet a corner, up to rounding.
std::optional<std::uint32_t> widest_angle(const PlanarGrid& grid, const std::vector<char>& is_corner,
                                          const Eigen::Vector2d& a, const Eigen::Vector2d& b);

}  // namespace pcl_bv::detail
