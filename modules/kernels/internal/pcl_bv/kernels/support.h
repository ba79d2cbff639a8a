// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Finds the support points of a chunk, which are the points with the largest projections on given directions
// (FIND-k-DOP of Karlsson, Winberg and Larsson 2010). Floating-point vectors reject nearly all points. The
// remaining points are compared exactly.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/directions.h"
#include "pcl_bv/numeric/exact_dot.h"
#include "pcl_bv/points/isa.h"
#include "pcl_bv/points/point_view.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Maximum number of directions of chunk_supports(). It equals KdopSet::max_size, which is half the number of
/// points of EPOS-98.
inline constexpr std::size_t kMaxSupportDirections = 49;
inline constexpr std::size_t kMaxSupports = 2 * kMaxSupportDirections;

/// The directions of chunk_supports(). Each direction k has two supports. Support 2k belongs to the minimum
/// projection on direction k, and support 2k + 1 to the maximum projection. The minimum is computed as the
/// maximum projection on the opposite direction. So each support is the point with the maximum projection on
/// its support_direction().
struct SupportDirections {
  std::size_t count = 0;
  std::array<Direction, kMaxSupportDirections> exact{};
  /// `exact` times a power of two, so that the largest component is in [1, 2) in magnitude. (Tiny components
  /// may be rounded.)
  std::array<Direction, kMaxSupportDirections> scaled{};
  /// The DirectionSet that has exactly these directions, if any. Its projections need no multiplications.
  std::optional<DirectionSet> cube;

  /// Returns the directions of a DirectionSet.
  static const SupportDirections& of(DirectionSet set);

  /// Appends a direction. It must be finite, and its largest component must be from 1e-30 to 1e30 in
  /// magnitude. Throws std::invalid_argument for other directions, and if there are kMaxSupportDirections
  /// already.
  void add(const Direction& direction);
  /// Returns the direction on which the support has the maximum projection: exact[support / 2] if `support`
  /// is odd, the opposite direction if `support` is even.
  Direction support_direction(std::size_t support) const;
  /// Like support_direction(), but returns a direction of `scaled` or its opposite.
  Direction scaled_support_direction(std::size_t support) const;
};

/// The point with the largest projection on a direction.
struct SupportPoint {
  bool found = false;
  Coordinates point{};
  std::size_t index = 0;  ///< Index of the point in the cloud.
};

/// Sets `best` to `other` if the exact projection of `other` on the direction is larger than that of `best`,
/// or if both projections are equal and the index of `other` is smaller.
void keep_larger_projection(const Direction& direction, const SupportPoint& other, SupportPoint& best);

/// Known lower bounds of a cloud's maximum projections, one per support. If the bound of a support is finite,
/// the cloud has a known point whose projection on the scaled_support_direction() is certainly at least the
/// bound. Points with smaller projections need not be found. The bound is -infinity if no such point is
/// known.
using SupportBounds = std::array<double, kMaxSupports>;

/// Returns -infinity for each support, which means that no bound is known.
inline constexpr SupportBounds no_support_bounds() {
  SupportBounds bounds{};
  for (double& bound : bounds)
    bound = -kInfinity;
  return bounds;
}

/// Returns a lower bound of the exact projection of a point on scaled_support_direction(support), for use in
/// SupportBounds.
double projection_lower_bound(const SupportDirections& set, std::size_t support, const Coordinates& point);

/// The supports of a chunk. Only the first 2 * SupportDirections::count elements of `supports` are used.
struct ChunkSupports {
  /// SupportPoint::found is false only if no valid point has a projection of at least the support's bound.
  std::array<SupportPoint, kMaxSupports> supports{};
  std::size_t dropped = 0;  ///< Number of points that are not valid (is_valid()).
};

/// Finds the support points of at most kChunkPoints points, which are the points with the largest exact
/// projections. If several points have the largest projection, the one with the smallest index is the support
/// point. If the projection of the support point is at least the support's element of `bounds`, the support
/// point is found and is the same for every `isa`. Otherwise, whether it is found depends on `isa`.
///
/// O(n * set.count). If floats overflow or underflow, all points are compared exactly, which is slow. Floats
/// overflow for extents above 1e38. Without SupportDirections::cube, they underflow for extents below 1e-43.
/// Needs at most 220 KiB of stack. The caller must hold a FloatEnvironment. Throws std::invalid_argument for
/// more than kChunkPoints points or kMaxSupportDirections directions, and if the points are not in memory.
void chunk_supports(UsableIsa isa, const PointView& chunk, const SupportDirections& set,
                    const SupportBounds& bounds, ChunkSupports& out);

}  // namespace detail
}  // namespace pcl_bv
