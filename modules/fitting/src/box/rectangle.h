// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The convex polygon and the smallest rectangle of points in the plane, in double arithmetic.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>

namespace pcl_bv::detail {

/// Moves the corners of the convex hull to the front of `points`, counter-clockwise, and returns the number
/// of corners. Equal points have 1 corner, points on a line 2. The result has rounding errors, so it may be
/// used to choose axes, but not to enclose points. planar_hull() is exact, but slower because it allocates.
/// O(n log n). Andrew 1979.
std::size_t to_convex_chain(Eigen::Vector2d* points, std::size_t count);

/// A rectangle in the plane, without its position.
struct Rectangle {
  Eigen::Vector2d side = Eigen::Vector2d::UnitX();  ///< Unit vector along a side.
  double width = 0, height = 0;                     ///< Extents along `side` and perpendicular to it.

  double area() const { return width * height; }
  double diagonal() const { return std::sqrt(width * width + height * height); }
};

/// Returns the rectangle of minimum area around a convex polygon of 1 corner or more, as returned by
/// to_convex_chain(). Such a rectangle has a side along an edge of the polygon (Freeman, Shapira 1975), so
/// only rectangles along edges are compared. Uses rotating calipers (Toussaint 1983). O(corners).
Rectangle smallest_rectangle(const Eigen::Vector2d* corners, std::size_t count);

}  // namespace pcl_bv::detail
