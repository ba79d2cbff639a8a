// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A simple polygon around points of a plane that follows the bays between them.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace pcl_bv::detail {

/// Returns a simple polygon that contains all points, as Prism::outline() requires. Its corners are points.
/// `hull` must have the corners of the convex hull of the points, at least three, as planar_hull() returns
/// them.
///
/// Begins with the hull. Replaces edges a -> b that are longer than `length` by a -> p -> b. Takes the
/// longest such edge first; tries each edge once. p is a point inside for which the triangle a, p, b has no
/// other point and no part of another edge. Edges without such a point stay. After Duckham et al. 2008,
/// without a triangulation of all points. Exact arithmetic decides what is inside. The result does not depend
/// on the order of the points.
std::vector<Eigen::Vector2d> concave_outline(const std::vector<Eigen::Vector2d>& hull,
                                             const std::vector<Eigen::Vector2d>& points, double length);

}  // namespace pcl_bv::detail
