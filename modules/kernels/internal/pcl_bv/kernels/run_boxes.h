// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Boxes around short runs of a cloud. A sensor's points that follow one another are mostly neighbours.
#pragma once

#include <cstddef>

#include "pcl_bv/points/isa.h"
#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Points of a run: four vectors of AVX-512.
inline constexpr std::size_t kRunPoints = 64;

/// Sides of a box; of doubles rounded outward. low is infinity and high -infinity where nothing is.
struct RunBox {
  float low[3], high[3];
};

/// Sets boxes[r] to one around the visited points 64 r to 64 r + 63. A NaN is passed over, but not what else
/// its point has, nor an infinity. The same for every `isa`. O(n). Runs in the caller's floating-point
/// environment: hold a FloatEnvironment. Throws std::invalid_argument unless the points are in memory.
void run_boxes(UsableIsa isa, const PointView& points, RunBox* boxes);

}  // namespace pcl_bv
