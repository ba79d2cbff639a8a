// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The second kernel: which points are how far from a centre? What growing a sphere, and finding the smallest
// one, asks of a cloud (paper §3, Figure 3).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "pcl_bv/points/chunks.h"
#include "pcl_bv/points/isa.h"
#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// A place to measure from, whose coordinates is_valid() allows, and the unit to measure in. `scale` is a
/// power of two, and 1 for float views: their squares stay in the range of double by themselves. With it,
/// distances of about 1 come out.
struct DistanceCenter {
  double x = 0, y = 0, z = 0;
  double scale = 1;
};

/// The squared distance that everything here is decided by: with q = (p - center) scale by coordinate,
/// (qx^2 + qy^2) + qz^2, each step rounded to double. For a valid point it is off by at most 5 2^-53 of
/// itself (and by what underflows).
double squared_distance(const Coordinates& p, const DistanceCenter& center);

/// Whether float arithmetic may spare double arithmetic most blocks. Changes no result, only speed: `reject`
/// pays where most blocks are clearly inside, not where nearly all points are equally far. For extents from
/// 1e-30 to 1e18; beyond, squares of floats vanish or overflow and all is decided in double anyway.
enum class FloatFilter : std::uint8_t { off, reject };

constexpr std::size_t block_count(std::size_t points) {
  return (points + kBlockPoints - 1) / kBlockPoints;
}

/// Points that share one bound of scan_octants(), and bounds of a block.
inline constexpr std::size_t kBoundPoints = 8;
inline constexpr std::size_t kBlockBounds = kBlockPoints / kBoundPoints;

/// What scan_octants() is asked, and its answer.
struct OctantScan {
  DistanceCenter center;
  double limit = 0;                       ///< Points with a smaller squared_distance() do not matter.
  FloatFilter filter = FloatFilter::off;  ///< Comes back as `off` where floats rejected little.
  float* bounds = nullptr;                ///< If not null, kBlockBounds entries for list_reaching().

  /// The greatest squared_distance() of the points that matter in each octant around the centre: bit 0 of the
  /// octant's number is set where qx > 0, bit 1 where qy > 0, bit 2 where qz > 0. -1 without such a point.
  std::array<double, 8> greatest{};
};

/// Scans one block. `greatest` is the same for each `isa`, the others are not. O(n). Runs in the caller's
/// floating-point environment: hold a FloatEnvironment. Throws std::invalid_argument for more than
/// kBlockPoints points, unless they are in memory, and for float points whose centre has a scale other than 1.
void scan_octants(UsableIsa isa, const PointView& block, OctantScan& scan);

/// What scan_octants() of a float block left, and how far from its centre points must be to be asked for now.
struct KeptBounds {
  const float* bounds = nullptr;
  double limit = 0;  ///< Squared; points nearer to that centre are not looked at.
};

/// Writes positions in the block, in any order, of points with a squared_distance() of at least `limit` to
/// `center`, among them all valid ones whose squared_distance() to that scan's is at least kept.limit.
/// Returns how many; there must be room for kBlockPoints. Looks at few points where few reach. `isa`: the one
/// that the bounds are of. Throws as scan_octants(), also for a block of doubles and without bounds.
std::size_t list_reaching(UsableIsa isa, const PointView& block, const KeptBounds& kept,
                          const DistanceCenter& center, double limit, std::uint32_t* positions);

/// The octant of a point, as scan_octants() counts them.
std::size_t octant(const Coordinates& p, const DistanceCenter& center);

/// Writes the positions in the view, ascending, of the valid points whose squared_distance() is at least
/// `limit`; returns how many. There must be room for points.count, at most 2^32. The same for
/// every `isa` and filter; otherwise as scan_octants().
std::size_t list_distant(UsableIsa isa, const PointView& points, const DistanceCenter& center, double limit,
                         FloatFilter filter, std::uint32_t* positions);

}  // namespace pcl_bv
