// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Plain loops for k-DOPs over pcl::PointXYZ, as one writes them who neither vectorises nor tests points.
#pragma once

#include <array>
#include <cstddef>

#include "pcl_bv/numeric/directions.h"

namespace pcl_bv::bench {
using namespace detail;

/// Bounds along as many directions as were asked for.
struct PlainDop {
  std::array<float, kMaxDirections> low;
  std::array<float, kMaxDirections> high;
};

/// Every direction's product written out, results kept in memory, built with -O2: the kind of sequential code
/// that the paper compares with. `xyzw` has 4 floats per point, at least one point; of the first 3, 7 or 13
/// of kCubeDirections.
template <std::size_t directions>
PlainDop naive_dop(const float* xyzw, std::size_t points);

/// All 13 directions with local accumulators and the paper's shared sums, built with -O3 -fno-tree-vectorize.
PlainDop plain_dop26(const float* xyzw, std::size_t points);

}  // namespace pcl_bv::bench
