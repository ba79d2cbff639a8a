// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// First and second moments of a block of points, from which means and covariances are computed.
#pragma once

#include <array>
#include <cstddef>

#include "pcl_bv/points/isa.h"
#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Sums over the valid points p of q = (p - origin) * 2^exponent.
struct Moments {
  std::size_t count = 0;            ///< Number of valid points.
  Coordinates origin{};             ///< The first valid point.
  int exponent = 0;                 ///< 0, 500 or 1000.
  std::array<double, 3> sum{};      ///< Sums of x, y, z of q.
  std::array<double, 6> product{};  ///< Sums of xx, xy, xz, yy, yz, zz of q.
};

/// Returns the moments of at most kBlockPoints points, summed in double. The result has the same bits for
/// every `isa`. Without valid points the count and all sums are 0.
///
/// The sums are made in 8 lanes, by the point's position modulo 8; then the lanes are added in order. So each
/// sum is off by at most 140 rounding errors of the sum of magnitudes (128 points a lane, 8 lanes, the
/// subtraction and the product). The exponent keeps squares of doubles from vanishing: it is the smallest
/// with which the sum of all squares is at least 2^-660, or 1000 if there is none. For floats it is 0.
///
/// O(n). The caller must hold a FloatEnvironment. Throws std::invalid_argument for more points, and if the
/// points are not in memory.
Moments block_moments(UsableIsa isa, const PointView& block);

}  // namespace pcl_bv
