// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The one place that speaks to Qhull (Barber, Dobkin, Huhdanpaa 1996).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace pcl_bv {

/// Positions of three points, counter-clockwise seen from outside.
using Triangle = std::array<std::int32_t, 3>;

/// The triangles of the convex hull, each beginning with its smallest position, in ascending order. Of points
/// that span three dimensions, with coordinates of about 1. Up to rounding: a point 1e-15 above a triangle
/// may be left out, and slivers may lean inward by as much. None where even that fails. Same input, same
/// output; any thread; nothing is printed. O(n log n).
std::vector<Triangle> hull_triangles(const std::vector<Eigen::Vector3d>& points);

/// Whether each edge of a triangle is, the other way round, an edge of another one: then they are the surface
/// of a solid.
bool is_closed(const std::vector<Triangle>& triangles);

}  // namespace pcl_bv
