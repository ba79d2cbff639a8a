// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The first kernel: how far do points reach along fixed directions? Its results are floating-point extents by
// block, from which fitting finds the exact ones.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "pcl_bv/kernels/isa.h"
#include "pcl_bv/kernels/point_view.h"

namespace pcl_bv {

/// The directions of the paper's k-DOPs, taken from the unit cube and not normalised; all coefficients are
/// -1, 0, 1. Sums are always formed as (x +- y) +- z.
// clang-format off
inline constexpr std::array<std::array<std::int8_t, 3>, 13> kCubeDirections = {{
    {1, 0, 0}, {0, 1, 0}, {0, 0, 1},                                      // through the faces
    {1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {1, -1, -1},                       // through the corners
    {1, 1, 0}, {1, -1, 0}, {1, 0, 1}, {1, 0, -1}, {0, 1, 1}, {0, 1, -1},  // through the edges
}};
// clang-format on
inline constexpr std::size_t kMaxDirections = kCubeDirections.size();

/// A choice of kCubeDirections, in that order.
enum class DirectionSet : std::uint8_t { dop6, dop14, dop18, dop26 };

/// Number of directions of a set: 3, 7, 9 or 13.
constexpr std::size_t direction_count(DirectionSet set) {
  constexpr std::size_t counts[] = {3, 7, 9, 13};
  return counts[static_cast<std::size_t>(set)];
}

/// Position in kCubeDirections of the k-th direction of a set (dop18 skips the corners).
constexpr std::size_t cube_direction(DirectionSet set, std::size_t k) {
  return set == DirectionSet::dop18 && k >= 3 ? k + 4 : k;
}

/// Points per block. Large enough to hide the reduction of 26 vectors, small enough that a rescan of the
/// blocks that hold the extremes is cheap.
inline constexpr std::size_t kBlockPoints = 1024;

constexpr std::size_t block_count(std::size_t points) {
  return (points + kBlockPoints - 1) / kBlockPoints;
}

/// Least and greatest projection of one block's valid points, in the arithmetic of the view's scalar type
/// (float sums of float coordinates), for the first direction_count() entries. No valid point: +infinity and
/// -infinity. Never -0.
struct BlockExtents {
  std::array<double, kMaxDirections> low;
  std::array<double, kMaxDirections> high;
  std::size_t
      dropped;  ///< Points of the block with a coordinate that is not valid (is_valid() in point_view.h).
};

/// Fills block_count(points.count) entries of `blocks`; block b holds the points [b, b + 1) * kBlockPoints.
///
/// The same bits for every `isa`, which must come from resolve_isa(). Paper §2, Figure 2. Never throws. O(n).
/// Runs in the caller's floating-point environment: hold a FloatEnvironment.
void block_extents(Isa isa, const PointView& points, DirectionSet set, BlockExtents* blocks);

}  // namespace pcl_bv
