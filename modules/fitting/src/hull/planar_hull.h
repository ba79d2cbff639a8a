// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace pcl_bv {

/// Positions of the corners of the convex hull, counter-clockwise, from the one with the smallest (x, y) on.
/// No three of them are collinear and no two equal; of equal points the one with the smallest position.
/// Points on a line: its two ends; equal points: one. Decided in exact arithmetic; coordinates finite, up to
/// 1e100. O(n log n).
///
/// Andrew 1979 (monotone chain).
std::vector<std::size_t> planar_hull(const std::vector<Eigen::Vector2d>& points);

/// -1, 0 or 1: the sign of (b - a) x (c - a), exactly; 1 if c is to the left of a -> b.
int turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

}  // namespace pcl_bv
