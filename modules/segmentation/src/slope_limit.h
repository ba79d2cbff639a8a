// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Limits the slope of the ground.
#pragma once

#include <cstddef>

#include "zone_points.h"

namespace pcl_bv::detail {

/// Lowers the heights of the first `rings` rings of cells to the highest surface whose slope against the
/// horizontal is at most `max_slope` (a tangent) in every direction. Heights are relative to `plane`, metres.
/// Distances are path lengths from cell to cell (Borgefors 1986). They exceed straight distances by at most 8
/// % if cells are as wide as long, else by up to a fifth. O(cells).
void limit_slopes(float* heights, std::size_t rings, const Slope& plane, float max_slope);

}  // namespace pcl_bv::detail
