// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "pcl_bv/numeric/coordinates.h"

namespace pcl_bv {

/// Numbers of three vertices, counter-clockwise seen from outside.
using Triangle = std::array<std::int32_t, 3>;

struct ConvexHull {
  /// Positions of the extreme points, ascending: those that are not in the hull of all others. Of equal
  /// points the first.
  std::vector<std::size_t> vertices;

  /// A closed surface; each begins with its smallest vertex, in ascending order. Faces with more than three
  /// corners are cut into triangles, in a way that depends on the vertices alone. None if the points are in
  /// a plane.
  std::vector<Triangle> triangles;
};

/// The convex hull of finite points of up to 1e100 in magnitude, in exact arithmetic: what it says does not
/// change if points inside are left out. No point: nothing; points on a line: its ends; in a plane: the
/// corners of a polygon. Needs a FloatEnvironment. O(n log n) where points are as usual, O(n^2) at worst.
///
/// Barber, Dobkin, Huhdanpaa 1996 (Quickhull), with predicates of Shewchuk 1997.
ConvexHull convex_hull(const std::vector<Coordinates>& points);

/// Keeps the extreme ones of things that have a `point`, and gives the triangles of their hull.
template <typename Thing>
std::vector<Triangle> keep_extreme(std::vector<Thing>& things) {
  std::vector<Coordinates> points;
  points.reserve(things.size());
  for (const Thing& thing : things)
    points.push_back(thing.point);
  ConvexHull hull = convex_hull(points);
  std::vector<Thing> extreme;  // of its own, as `things` would keep the memory of all
  extreme.reserve(hull.vertices.size());
  for (const std::size_t i : hull.vertices)
    extreme.push_back(things[i]);
  things = std::move(extreme);
  return std::move(hull.triangles);
}

/// -1, 0 or 1: the side of the plane through a, b and c that p is on, exactly; 1 where they are
/// counter-clockwise seen from p.
int side_of_plane(const Coordinates& a, const Coordinates& b, const Coordinates& c, const Coordinates& p);

}  // namespace pcl_bv
