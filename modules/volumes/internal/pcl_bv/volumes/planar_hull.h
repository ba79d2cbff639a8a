// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The exact convex hull of points in the plane.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Returns the positions of the corners of the convex hull, counter-clockwise, beginning with the corner that
/// has the smallest (x, y). No three corners are collinear and no two are equal. Of equal points only the
/// first can be a corner. Points on a line give the two ends, equal points give one corner. The arithmetic is
/// exact. Coordinates must be at most 1e100 in magnitude. O(n log n).
std::vector<std::size_t> planar_hull(const std::vector<Eigen::Vector2d>& points);

/// Returns the exact sign of (b - a) x (c - a): 1 if c is to the left of a -> b, -1 if c is to the right, 0
/// if c is on the line.
int orientation(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

}  // namespace detail
}  // namespace pcl_bv
