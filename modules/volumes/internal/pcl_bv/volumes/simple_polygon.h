// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Simple polygons, which need not be convex. Exact arithmetic decides everything in this file.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Returns whether two closed segments, a to b and c to d, have a point in common.
bool segments_touch(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                    const Eigen::Vector2d& d);

/// Returns whether the corners are those of a simple polygon with at least three corners, counter-clockwise.
/// Two edges that follow each other have only their corner in common, and are not on one line. Any other two
/// edges have no point in common. O(n log n) for n corners of which few have nearly equal x, O(n^2) at most.
bool is_simple_polygon(const std::vector<Eigen::Vector2d>& corners);

/// Returns whether a simple polygon contains the point. The boundary belongs to the polygon. O(n).
bool polygon_contains(const std::vector<Eigen::Vector2d>& corners, const Eigen::Vector2d& p);

/// Returns the corners of the polygon that are not on the line through the corner before and the corner
/// after. The polygon stays the same set of points.
std::vector<Eigen::Vector2d> without_straight_corners(const std::vector<Eigen::Vector2d>& corners);

/// Returns triangles that together are a simple polygon, as positions of corners, counter-clockwise. They
/// overlap only in edges. n - 2 triangles by ear clipping (Meisters 1975), O(n^2) for usual polygons.
std::vector<std::array<std::size_t, 3>> triangles_of(const std::vector<Eigen::Vector2d>& corners);

/// Returns a simple polygon that contains every point whose coordinates differ from those of a point of the
/// given simple polygon by at most `distance`. Its edges are those of the given polygon, moved outward by
/// about four times the distance. Returns nothing if this gives no such polygon, for example because two
/// edges are nearer to each other than this. O(n log n) for usual polygons.
std::optional<std::vector<Eigen::Vector2d>> polygon_around(const std::vector<Eigen::Vector2d>& corners,
                                                           double distance);

}  // namespace detail
}  // namespace pcl_bv
