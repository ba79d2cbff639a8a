// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// First and second moments of a chunk, with the same bits everywhere: what means and covariances are made of.
#pragma once

#include <array>
#include <cstddef>

#include "pcl_bv/kernels/isa.h"
#include "pcl_bv/kernels/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Sums over the valid points of the coordinates relative to an origin.
struct Moments {
  std::array<double, 3> sum{};      ///< x, y, z
  std::array<double, 6> product{};  ///< xx, xy, xz, yy, yz, zz
  std::size_t count = 0;            ///< Points summed.
};

/// Sums in double over blocks of kBlockPoints, in 8 lanes by the point's position in the chunk modulo 8;
/// lanes of the blocks, then the lanes themselves, are added in order. So each sum is off by at most 171
/// rounding errors of the sum of magnitudes (128 points a lane, 32 blocks, 8 lanes, the subtraction and the
/// product) in a chunk of kChunkPoints.
///
/// `origin` must be a valid point of the cloud's scalar type: a point of the cloud, say. `isa` changes no
/// bit. O(n). Runs in the caller's floating-point environment: hold a FloatEnvironment. Throws
/// std::invalid_argument for another origin, for more than kChunkPoints points, and unless they are in
/// memory.
void chunk_moments(UsableIsa isa, const PointView& chunk, const Coordinates& origin, Moments& out);

}  // namespace pcl_bv
