// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>

namespace pcl_bv {

/// Moves the corners of the convex hull to the front, counter-clockwise, and returns how many: 1 of equal
/// points, 2 of points on a line. In plain double, for those who choose axes, not for those who must enclose;
/// planar_hull.h is exact, and slower by an allocation. O(n log n). Andrew 1979.
std::size_t to_convex_chain(Eigen::Vector2d* points, std::size_t count);

struct FlatBox {
  Eigen::Vector2d side = Eigen::Vector2d::UnitX();  ///< Unit vector along a side.
  double width = 0, height = 0;                     ///< Along it, and across.

  double area() const { return width * height; }
  double diagonal() const { return std::sqrt(width * width + height * height); }
};

/// The rectangle of least area around a convex polygon of 1 corner or more, as to_convex_chain() leaves it:
/// of those with a side along an edge, which the least one is among (Freeman, Shapira 1975). Rotating
/// calipers (Toussaint 1983): O(corners).
FlatBox least_rectangle(const Eigen::Vector2d* corners, std::size_t count);

}  // namespace pcl_bv
