// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// First and second moments of a block, with the same bits everywhere: what means and covariances are made of.
#pragma once

#include <array>
#include <cstddef>

#include "pcl_bv/points/isa.h"
#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Sums over valid points p of q = (p - origin) 2^exponent.
struct Moments {
  std::size_t count = 0;            ///< Points summed.
  Coordinates origin{};             ///< One of them.
  int exponent = 0;                 ///< 0, 500 or 1000.
  std::array<double, 3> sum{};      ///< x, y, z of q.
  std::array<double, 6> product{};  ///< xx, xy, xz, yy, yz, zz of q.
};

/// Sums in double over at most kBlockPoints points, about the first valid one, in 8 lanes by the point's
/// position modulo 8; then the lanes are added in order. So each sum is off by at most 140 rounding errors of
/// the sum of magnitudes (128 points a lane, 8 lanes, the subtraction and the product). The exponent is 0 but
/// for doubles whose squares would vanish: the least one with which the sum of all squares is 2^-660 or more,
/// 1000 if there is none.
///
/// No valid point: zeros, and a count of 0. `isa` changes no bit. O(n). Runs in the caller's floating-point
/// environment: hold a FloatEnvironment. Throws std::invalid_argument for more points, and unless they are in
/// memory.
Moments block_moments(UsableIsa isa, const PointView& block);

}  // namespace pcl_bv
