// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Lists the points of a cloud that are outside a convex polytope. If the polytope is spanned by points of the
// cloud, the points inside it cannot be vertices of the cloud's convex hull.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "pcl_bv/points/isa.h"
#include "pcl_bv/points/point_view.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Maximum number of half-spaces, which is the maximum number of facets of a polytope with 26 vertices.
inline constexpr std::size_t kMaxHalfSpaces = 48;

/// The half-space of all q with n . q below `limit`, where q is a point relative to a centre. HalfSpaces
/// treats the boundary (n . q = limit) as outside, ConvexRegion treats it as inside.
struct HalfSpace {
  double x = 0, y = 0, z = 0;  ///< Normal n.
  double limit = 0;
};

/// A convex polytope, which is the intersection of half-spaces relative to a centre. A point p is inside if
/// (x (px - cx) + y (py - cy)) + z (pz - cz) < limit for each half-space, each step rounded to the scalar
/// type of the points. Points with a NaN are never inside. Without half-spaces, only the points of the ball
/// (see squared_ball) are inside.
struct HalfSpaces {
  Coordinates center{};
  std::size_t count = 0;
  std::array<HalfSpace, kMaxHalfSpaces> planes{};

  /// A point is inside without further tests if its rounded squared distance from the centre is below this
  /// value. 0 means no ball. The half-spaces must contain the ball with a margin for the rounding in the
  /// tests of the ball and of the half-spaces.
  double squared_ball = 0;
};

/// Lists the points that are not inside the polytope. Writes their positions in the view in ascending order
/// and returns their number. `positions` needs a capacity of points.count, which is at most 2^32. The list is
/// the same for every `isa`. O(n * inside.count) at worst. The caller must hold a FloatEnvironment. Throws
/// std::invalid_argument for more than 2^32 points or kMaxHalfSpaces half-spaces, and if the points are not
/// in memory.
std::size_t list_outside(UsableIsa isa, const PointView& points, const HalfSpaces& inside,
                         std::uint32_t* positions);

}  // namespace detail
}  // namespace pcl_bv
