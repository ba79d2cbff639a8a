// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Distances of points from a centre. They are used to grow a sphere around a cloud and to find the smallest
// enclosing sphere (Karlsson, Winberg and Larsson 2010, section 3, Figure 3).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "pcl_bv/points/isa.h"
#include "pcl_bv/points/point_source.h"
#include "pcl_bv/points/point_view.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// A centre from which distances are measured, and a factor for the distances. The centre must be valid
/// (is_valid()). `scale` is a power of two that brings the distances near 1. For float points `scale` must be
/// 1. They need no scaling, because their squared distances cannot leave the range of double.
struct DistanceCenter {
  double x = 0, y = 0, z = 0;
  double scale = 1;
};

/// Returns the squared distance (qx^2 + qy^2) + qz^2 with q = (p - center) * scale, each step rounded to
/// double. scan_octants() and the functions that list points compare this value with a limit. For a valid
/// point, the relative error of the value is at most 5 * 2^-53, plus underflow.
double squared_distance(const Coordinates& p, const DistanceCenter& center);

/// Whether a test in float arithmetic rejects points nearer than the limit, so that only the remaining points
/// are tested in double arithmetic. The choice changes the speed and OctantScan::bounds, but no other result.
/// `reject` is faster if nearly all points are clearly nearer than the limit. It is not faster if nearly all
/// points have about the same distance from the centre. Use `reject` for extents from 1e-30 to 1e18. For
/// other extents, squares of floats underflow or overflow, and every point is tested in double arithmetic
/// anyway.
enum class FloatFilter : std::uint8_t { off, reject };

/// Returns the number of blocks of a cloud. The last block may be shorter than kBlockPoints.
constexpr std::size_t block_count(std::size_t points) {
  return (points + kBlockPoints - 1) / kBlockPoints;
}

/// Number of points that share one bound in OctantScan::bounds, and number of bounds of a block.
inline constexpr std::size_t kBoundPoints = 8;
inline constexpr std::size_t kBlockBounds = kBlockPoints / kBoundPoints;

/// Arguments and results of scan_octants().
struct OctantScan {
  DistanceCenter center;
  double limit = 0;                       ///< Points with a smaller squared_distance() are ignored.
  FloatFilter filter = FloatFilter::off;  ///< scan_octants() switches it off if it rejects few points.
  float* bounds = nullptr;                ///< Null, or an array for kBlockBounds bounds (see ScanBounds).

  /// Result: the largest squared_distance() of the valid points in each octant around the centre. The value
  /// is -1 for an octant in which no valid point has a squared_distance() of at least `limit`. The index of
  /// an octant has bit 0 set if qx > 0, bit 1 if qy > 0, bit 2 if qz > 0.
  std::array<double, 8> max_squared{};
};

/// Scans one block of at most kBlockPoints points. `max_squared` is the same for every `isa`, but the
/// resulting `filter` and bounds may differ. O(n). The caller must hold a FloatEnvironment. Throws
/// std::invalid_argument for more than kBlockPoints points, for points that are not in memory, and for float
/// points if the scale is not 1.
void scan_octants(UsableIsa isa, const PointView& block, OctantScan& scan);

/// The bounds that scan_octants() wrote for a block of float points, and the limit below which
/// list_distant_by_bounds() may skip points. A bound is the largest squared distance, in float, of
/// kBoundPoints points from the centre of the scan. It is infinite if these points were not tested in float.
struct ScanBounds {
  const float* bounds = nullptr;
  double limit = 0;  ///< Points with a smaller squared distance from the centre of the scan may be skipped.
};

/// Lists the points that have a squared_distance() of at least `limit` from `center`. Writes the positions of
/// these points in the block, in any order, and returns their number. `positions` needs a capacity of
/// kBlockPoints.
///
/// All such points are listed, with two exceptions. Points whose squared_distance() from the centre of the
/// scan is below scanned.limit may be missing. Points with an infinite coordinate may be missing, too. The
/// function is fast if only a small number of the bounds exceeds scanned.limit. `isa` must be the instruction
/// set with which scan_octants() wrote the bounds. Throws like scan_octants(). Also throws
/// std::invalid_argument for double points and for null bounds.
std::size_t list_distant_by_bounds(UsableIsa isa, const PointView& block, const ScanBounds& scanned,
                                   const DistanceCenter& center, double limit, std::uint32_t* positions);

/// Returns the octant of a point, as defined for OctantScan::max_squared.
std::size_t octant(const Coordinates& p, const DistanceCenter& center);

/// Lists the valid points that have a squared_distance() of at least `limit`. Writes the positions of these
/// points in the view in ascending order and returns their number. `positions` needs a capacity of
/// points.count, which is at most 2^32. The list is the same for every `isa` and `filter`. O(n). The caller
/// must hold a FloatEnvironment. Throws std::invalid_argument for more than 2^32 points, for points that are
/// not in memory, and for float points if the scale is not 1.
std::size_t list_distant(UsableIsa isa, const PointView& points, const DistanceCenter& center, double limit,
                         FloatFilter filter, std::uint32_t* positions);

}  // namespace detail
}  // namespace pcl_bv
