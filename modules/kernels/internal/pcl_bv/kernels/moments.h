// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// First and second moments of a block of points, from which means and covariances are computed.
#pragma once

#include <array>
#include <cstddef>

#include "pcl_bv/points/isa.h"
#include "pcl_bv/points/point_source.h"
#include "pcl_bv/points/point_view.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Sums over the valid points p of a block, computed from q = (p - origin) * 2^exponent.
struct Moments {
  std::size_t count = 0;            ///< Number of valid points.
  Coordinates origin{};             ///< The first valid point.
  int exponent = 0;                 ///< 0, 500 or 1000.
  std::array<double, 3> sum{};      ///< Sums of x, y, z of q.
  std::array<double, 6> product{};  ///< Sums of xx, xy, xz, yy, yz, zz of q.
};

/// The offsets p - origin of the points p of a block, rounded to double. An invalid point has the offset 0.
/// The first element is that of the first point. Zeros follow the last point, so that `count` is a multiple
/// of 8. The other elements are not initialised.
struct BlockOffsets {
  BlockOffsets() {}
  std::size_t count = 0;
  alignas(kGroupBytes) double x[kBlockPoints];
  alignas(kGroupBytes) double y[kBlockPoints];
  alignas(kGroupBytes) double z[kBlockPoints];
};

/// Returns the moments of at most kBlockPoints points, summed in double. The result has the same bits for
/// every `isa`. Without valid points the count and all sums are 0.
///
/// Each sum has 8 lanes. The point at position i of the block is added to lane i modulo 8. Then the lanes are
/// added in order. So the error of each sum is at most 140 * 2^-53 times the sum of the magnitudes of its
/// terms. The 140 roundings are those of 128 points per lane, of 8 lanes, of the subtractions and of the
/// product.
///
/// The exponent keeps squares of doubles from underflowing. It is the smallest of 0, 500 and 1000 with which
/// the sum of all squares is at least 2^-660, or 1000 if none is sufficient. For floats the exponent is 0.
///
/// O(n). The caller must hold a FloatEnvironment. Throws std::invalid_argument for more than kBlockPoints
/// points, and if the points are not in memory.
Moments block_moments(UsableIsa isa, const PointView& block);

/// Same, and stores the offsets from Moments::origin. Without valid points the offsets are empty.
Moments block_moments(UsableIsa isa, const PointView& block, BlockOffsets& offsets);

}  // namespace detail
}  // namespace pcl_bv
