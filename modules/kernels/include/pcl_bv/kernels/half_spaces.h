// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Which points of a cloud are not inside a convex polytope: the others need not be looked at by whoever wants
// its hull.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "pcl_bv/points/isa.h"
#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// More half-spaces than this are never needed: the facets of a polytope of 26 vertices.
inline constexpr std::size_t kMaxHalfSpaces = 48;

/// A half-space and, in it, all that is to count as inside.
struct HalfSpace {
  double x = 0, y = 0, z = 0;  ///< Normal.
  double limit = 0;
};

/// A polytope as an intersection of half-spaces, seen from a centre. A point is inside if for each half-space
/// (x (px - cx) + y (py - cy)) + z (pz - cz) < limit, all of it rounded to the scalar type of the points,
/// step by step. Points with a NaN are never inside.
struct HalfSpaces {
  Coordinates center{};
  std::size_t count = 0;
  std::array<HalfSpace, kMaxHalfSpaces> planes{};

  /// Optional: points whose squared distance from the centre, rounded, is below this are inside without
  /// further tests. Only for a ball that the half-spaces hold with room for the rounding of both.
  double squared_ball = 0;
};

/// Writes the positions in the view, ascending, of the points that are not inside; returns how many. There
/// must be room for points.count, at most 2^32. The same for every `isa`. O(n count) at worst.
/// Runs in the caller's floating-point environment: hold a FloatEnvironment. Throws std::invalid_argument for
/// more points or half-spaces, and unless the points are in memory.
std::size_t list_outside(UsableIsa isa, const PointView& points, const HalfSpaces& inside,
                         std::uint32_t* positions);

}  // namespace pcl_bv
