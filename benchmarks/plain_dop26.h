// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Plain loops for the 26-DOP over pcl::PointXYZ, as one writes them who neither vectorises nor tests points.
#pragma once

#include <array>
#include <cstddef>

#include "pcl_bv/kernels/directions.h"

namespace pcl_bv::bench {

struct PlainDop26 {
  std::array<float, kMaxDirections> low;
  std::array<float, kMaxDirections> high;
};

/// Every direction's product written out, results kept in memory, built with -O2: the kind of sequential code
/// that the paper compares with. `xyz` has 4 floats per point, at least one point.
PlainDop26 naive_dop26(const float* xyzw, std::size_t points);

/// Local accumulators and the paper's shared sums, built with -O3 -fno-tree-vectorize.
PlainDop26 plain_dop26(const float* xyzw, std::size_t points);

}  // namespace pcl_bv::bench
