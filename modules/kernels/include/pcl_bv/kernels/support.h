// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// FIND-k-DOP: the support points of a chunk, those that reach farthest along given directions.
// Floating-point vectors reject nearly all points; the few that are left are compared exactly.
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

/// Directions per call of the kernel: KdopSet::max_size, the half of EPOS-98.
inline constexpr std::size_t kMaxSupportDirections = 49;
inline constexpr std::size_t kMaxSupportEnds = 2 * kMaxSupportDirections;

/// Directions with what the kernel needs to know of them. The two ends of each: 2k is its least projection,
/// 2k + 1 its greatest. An end is the greatest projection along end_direction().
struct SupportDirections {
  std::size_t count = 0;
  std::array<Direction, kMaxSupportDirections> exact{};
  /// A power of two times `exact`, the largest component in [1, 2) in magnitude. (Tiny components may be
  /// rounded.)
  std::array<Direction, kMaxSupportDirections> scaled{};
  std::optional<DirectionSet> cube;  ///< Of which they are the directions; needs no multiplications.

  static const SupportDirections& of(DirectionSet set);

  /// Throws std::invalid_argument for more than kMaxSupportDirections and unless this one is finite with its
  /// largest component from 1e-30 to 1e30 in magnitude.
  void add(const Direction& direction);
  Direction end_direction(std::size_t end) const;
  Direction scaled_end_direction(std::size_t end) const;
};

/// The point that is farthest in some direction.
struct SupportPoint {
  bool found = false;
  Coordinates point{};
  std::size_t index = 0;  ///< The cloud's number of the point.
};

/// Lets `best` compete with another one: the exactly greater projection wins; of equal ones the smaller
/// index.
void keep_farther(const Direction& direction, const SupportPoint& other, SupportPoint& best);

/// For each end a projection along the scaled direction that some other point of the cloud is known to reach;
/// -infinity if none is. Points that do not reach it need not be found.
using ReachedSupports = std::array<double, kMaxSupportEnds>;

inline constexpr ReachedSupports nothing_reached() {
  ReachedSupports reached{};
  for (double& r : reached)
    r = -kInfinity;
  return reached;
}

/// What a point surely reaches at an end, in the terms of ReachedSupports.
double surely_reached(const SupportDirections& set, std::size_t end, const Coordinates& point);

/// Only the first 2 count ends count.
struct ChunkSupports {
  std::array<SupportPoint, kMaxSupportEnds> ends{};  ///< Not found: no valid point, or none that matters.
  std::size_t dropped = 0;                           ///< Points that are not valid (is_valid()).
};

/// Finds the support points of at most kChunkPoints points: the exactly greatest projection; of equal ones
/// the smallest index. Whether an end that cannot beat `reached` is found may depend on `isa`; any that is
/// found is the same for all. Paper §2 and §3. O(n count), but along directions that are not the cube's every
/// point is looked at exactly where floats over- or underflow (extents above 1e38 or below 1e-43). Up to 220
/// KiB of stack. Runs in the caller's floating-point environment: hold a FloatEnvironment. Throws
/// std::invalid_argument for more points or directions, and unless the points are in memory.
void chunk_supports(UsableIsa isa, const PointView& chunk, const SupportDirections& set,
                    const ReachedSupports& reached, ChunkSupports& out);

}  // namespace pcl_bv
