// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Distances of points from a centre: for growing a sphere around a cloud and for finding the smallest one
// (Karlsson, Winberg and Larsson 2010, section 3, Figure 3).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "pcl_bv/points/chunks.h"
#include "pcl_bv/points/isa.h"
#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// A centre to measure distances from, and the unit to measure in. The centre must be valid (is_valid()).
/// `scale` is a power of two that brings distances near 1. It must be 1 for float views, whose squared
/// distances cannot leave the range of double.
struct DistanceCenter {
  double x = 0, y = 0, z = 0;
  double scale = 1;
};

/// Returns the squared distance by which all functions of this header decide: (qx^2 + qy^2) + qz^2 with
/// q = (p - center) * scale, each step rounded to double. For a valid point its relative error is at most
/// 5 * 2^-53, plus underflow.
double squared_distance(const Coordinates& p, const DistanceCenter& center);

/// Whether float arithmetic rejects points before double arithmetic decides. It changes no result, only the
/// speed: `reject` is faster if most blocks are clearly inside, but not if nearly all points are equally far.
/// Meant for extents from 1e-30 to 1e18: beyond, squares of floats vanish or overflow, and double arithmetic
/// decides about every point anyway.
enum class FloatFilter : std::uint8_t { off, reject };

/// Returns the number of blocks of a cloud; the last one may be shorter.
constexpr std::size_t block_count(std::size_t points) {
  return (points + kBlockPoints - 1) / kBlockPoints;
}

/// Number of points that share one bound of scan_octants(), and number of bounds of a block.
inline constexpr std::size_t kBoundPoints = 8;
inline constexpr std::size_t kBlockBounds = kBlockPoints / kBoundPoints;

/// Arguments and results of scan_octants().
struct OctantScan {
  DistanceCenter center;
  double limit = 0;                       ///< Points with a smaller squared_distance() are ignored.
  FloatFilter filter = FloatFilter::off;  ///< Set to `off` by the scan if floats rejected little.
  float* bounds = nullptr;                ///< Null, or kBlockBounds bounds to write (see ScanBounds).

  /// Result: the largest squared_distance() in each octant around the centre; -1 for an octant without a
  /// point of at least `limit`. The index of an octant has bit 0 set if qx > 0, bit 1 if qy > 0, bit 2 if
  /// qz > 0.
  std::array<double, 8> max_squared{};
};

/// Scans one block of at most kBlockPoints points. `max_squared` is the same for every `isa`; `filter` and
/// the bounds may differ. O(n). The caller must hold a FloatEnvironment. Throws std::invalid_argument for
/// more points, for points that are not in memory, and for float points if the scale is not 1.
void scan_octants(UsableIsa isa, const PointView& block, OctantScan& scan);

/// The bounds that scan_octants() wrote for a block of floats, and which points list_distant_by_bounds() may
/// skip.
struct ScanBounds {
  const float* bounds = nullptr;
  double limit = 0;  ///< Squared distance from the centre of that scan; nearer points may be skipped.
};

/// Lists the points that have a squared_distance() of at least `limit` from `center`. Writes their positions
/// in the block, in any order, and returns their number; `positions` needs a capacity of kBlockPoints.
///
/// All valid points whose squared_distance() from the centre of the scan is at least scanned.limit are
/// listed. Nearer points and infinite points may be listed as well. Cheap if few bounds exceed scanned.limit.
/// `isa` must be the one with which the bounds were written. Throws like scan_octants(), and for a block of
/// doubles or if the bounds are null.
std::size_t list_distant_by_bounds(UsableIsa isa, const PointView& block, const ScanBounds& scanned,
                                   const DistanceCenter& center, double limit, std::uint32_t* positions);

/// Returns the octant of a point, as defined for OctantScan::max_squared.
std::size_t octant(const Coordinates& p, const DistanceCenter& center);

/// Lists the valid points that have a squared_distance() of at least `limit`. Writes their positions in the
/// view in ascending order and returns their number; `positions` needs a capacity of points.count, which is
/// at most 2^32. The list is the same for every `isa` and `filter`. O(n). The caller must hold a
/// FloatEnvironment. Throws std::invalid_argument for more points, for points that are not in memory, and for
/// float points if the scale is not 1.
std::size_t list_distant(UsableIsa isa, const PointView& points, const DistanceCenter& center, double limit,
                         FloatFilter filter, std::uint32_t* positions);

}  // namespace pcl_bv
