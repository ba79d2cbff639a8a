// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Simple polygons, which need not be convex. The predicates are exact. Only polygon_around() computes rounded
// corners.
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
/// Neighbouring edges have only their corner in common, and are not on one line. Any other two edges have no
/// point in common. O(n^2) at worst, O(n log n) if few edges share a range of x.
bool is_simple_polygon(const std::vector<Eigen::Vector2d>& corners);

/// Returns whether the corners are those of their convex hull, in the same order, from any first corner on.
/// No three of them are then on one line. True for one corner and for two different ones. O(n log n).
bool is_strictly_convex(const std::vector<Eigen::Vector2d>& corners);

/// Returns whether a simple polygon contains the point. The boundary belongs to the polygon. O(n).
bool polygon_contains(const std::vector<Eigen::Vector2d>& corners, const Eigen::Vector2d& p);

/// Returns the corners of the polygon that are not on the line through the corner before and the corner
/// after. The polygon stays the same set of points.
std::vector<Eigen::Vector2d> without_straight_corners(const std::vector<Eigen::Vector2d>& corners);

/// Returns a triangulation (ear clipping): n - 2 counter-clockwise triples of corner positions (Meisters
/// 1975). Usually O(n^2). O(n^3) at worst, if most corners that are tried are not ears.
std::vector<std::array<std::size_t, 3>> triangles_of(const std::vector<Eigen::Vector2d>& corners);

/// Returns a simple polygon that contains every point whose coordinates differ from those of a point of the
/// given simple polygon by at most `distance`. Its edges are those of the given polygon, moved outward by
/// about four times the distance. Returns nothing if this gives no such polygon: if two edges are nearer to
/// each other than this, or if an angle, inside or outside, is below 0.11 degrees. The result can be convex
/// even if the given polygon is not. O(n^2) at worst, O(n log n) if few edges share a range of x.
std::optional<std::vector<Eigen::Vector2d>> polygon_around(const std::vector<Eigen::Vector2d>& corners,
                                                           double distance);

}  // namespace detail
}  // namespace pcl_bv
