// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The exact convex hull of points in space.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "pcl_bv/numeric/coordinates.h"

namespace pcl_bv::detail {

/// Indices of three vertices, counter-clockwise seen from outside.
using Triangle = std::array<std::int32_t, 3>;

/// Result of convex_hull().
struct ConvexHull {
  /// Positions of the extreme points in the input, ascending. An extreme point is not in the convex hull of
  /// all other points. Of several equal points, only the first can be a vertex.
  std::vector<std::size_t> vertices;

  /// The closed surface, as indices into `vertices`. Each triangle begins with its smallest index, and the
  /// triangles are in ascending order. Faces with more than three corners are divided into triangles in a way
  /// that depends on the vertices alone. Empty if the points are in a plane.
  std::vector<Triangle> triangles;
};

/// Computes the convex hull of points in exact arithmetic. The coordinates must be at most 1e100 in
/// magnitude. Without points, the hull is empty. Points on a line give the two ends, points in a plane the
/// corners of a polygon. O(n log n) for usual points, O(n^2) at worst. Needs a FloatEnvironment.
///
/// Barber, Dobkin, Huhdanpaa 1996 (Quickhull), with the predicates of Shewchuk 1997.
ConvexHull convex_hull(const std::vector<Coordinates>& points);

/// Removes all elements of `things` whose member `point` is not an extreme point. Returns the triangles of
/// the hull of the points.
template <typename Thing>
std::vector<Triangle> keep_extreme(std::vector<Thing>& things) {
  std::vector<Coordinates> points;
  points.reserve(things.size());
  for (const Thing& thing : things)
    points.push_back(thing.point);
  ConvexHull hull = convex_hull(points);
  std::vector<Thing> extreme;  // a new vector, because `things` would keep the memory of all elements
  extreme.reserve(hull.vertices.size());
  for (const std::size_t i : hull.vertices)
    extreme.push_back(things[i]);
  things = std::move(extreme);
  return std::move(hull.triangles);
}

/// Returns exactly on which side of the plane through a, b and c the point p is: 1 if a, b, c are
/// counter-clockwise seen from p, -1 if they are clockwise, 0 if p is in the plane.
int side_of_plane(const Coordinates& a, const Coordinates& b, const Coordinates& c, const Coordinates& p);

}  // namespace pcl_bv::detail
