// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// FIND-k-DOP (Karlsson, Winberg and Larsson 2010): the support points of a chunk, which are the points with
// the largest projections on given directions. Floating-point vectors reject nearly all points; the few that
// remain are compared exactly.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/directions.h"
#include "pcl_bv/numeric/exact_dot.h"
#include "pcl_bv/points/isa.h"
#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Maximum number of directions in one call: KdopSet::max_size, half the number of points of EPOS-98.
inline constexpr std::size_t kMaxSupportDirections = 49;
inline constexpr std::size_t kMaxSupports = 2 * kMaxSupportDirections;

/// The directions of a call. Each direction k has two supports: number 2k is the minimum of the projections
/// on it, number 2k + 1 the maximum. Each support is the maximum of the projections on its
/// support_direction(), which for a minimum is the opposite direction.
struct SupportDirections {
  std::size_t count = 0;
  std::array<Direction, kMaxSupportDirections> exact{};
  /// `exact` times a power of two, so that the largest component is in [1, 2) in magnitude. (Tiny components
  /// may be rounded.)
  std::array<Direction, kMaxSupportDirections> scaled{};
  std::optional<DirectionSet> cube;  ///< Set if these are its directions, which need no multiplications.

  /// Returns the directions of a DirectionSet.
  static const SupportDirections& of(DirectionSet set);

  /// Appends a direction. Throws std::invalid_argument if there are kMaxSupportDirections already, and unless
  /// the direction is finite with its largest component from 1e-30 to 1e30 in magnitude.
  void add(const Direction& direction);
  /// Returns the direction whose maximum projection is the given support: exact[support / 2] or
  /// its opposite.
  Direction support_direction(std::size_t support) const;
  /// The same for `scaled`.
  Direction scaled_support_direction(std::size_t support) const;
};

/// The point with the largest projection on a direction.
struct SupportPoint {
  bool found = false;
  Coordinates point{};
  std::size_t index = 0;  ///< Index of the point in the cloud.
};

/// Sets `best` to `other` if the exact projection of `other` on the direction is larger, or if it is equal
/// and the index smaller.
void keep_larger_projection(const Direction& direction, const SupportPoint& other, SupportPoint& best);

/// Known lower bounds of a cloud's supports: for each support a value that the projection of another point on
/// the scaled direction certainly equals or exceeds; -infinity if none is known. Points with smaller
/// projections need not be found.
using SupportBounds = std::array<double, kMaxSupports>;

/// Returns the bounds if nothing is known: -infinity for each support.
inline constexpr SupportBounds no_support_bounds() {
  SupportBounds bounds{};
  for (double& bound : bounds)
    bound = -kInfinity;
  return bounds;
}

/// Returns a lower bound of the exact projection of a point, for use in SupportBounds.
double projection_lower_bound(const SupportDirections& set, std::size_t support, const Coordinates& point);

/// The supports of a chunk. Only the first 2 * count of them are used.
struct ChunkSupports {
  std::array<SupportPoint, kMaxSupports> supports{};  ///< Not found: no point is valid or exceeds the bound.
  std::size_t dropped = 0;                            ///< Number of points that are not valid (is_valid()).
};

/// Finds the support points of at most kChunkPoints points: the points with the largest exact projections; of
/// equal projections the smallest index. A support that cannot exceed its bound in `bounds` may or may not
/// be found, depending on `isa`; every support that is found is the same for all `isa`.
///
/// O(n * count). For directions other than the cube's, all points are compared exactly if floats over- or
/// underflow (extents above 1e38 or below 1e-43), which is slow. Needs up to 220 KiB of stack. The caller
/// must hold a FloatEnvironment. Throws std::invalid_argument for more points or directions, and if the
/// points are not in memory.
void chunk_supports(UsableIsa isa, const PointView& chunk, const SupportDirections& set,
                    const SupportBounds& bounds, ChunkSupports& out);

}  // namespace pcl_bv
