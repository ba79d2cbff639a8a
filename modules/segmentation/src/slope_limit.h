// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Limits the slope of the ground.
#pragma once

#include <cstddef>

#include "zone_points.h"

namespace pcl_bv::detail {

/// Lowers the heights of the first `rings` rings of cells where the surface is steeper than `max_slope`. The
/// result is the highest surface that is nowhere above the old heights and nowhere steeper than `max_slope`.
/// `max_slope` is the tangent of an angle from the horizontal. Heights are relative to `plane`, metres.
/// Distances are path lengths from cell to cell (Borgefors 1986). If cells are as wide as long, path lengths
/// exceed straight distances by at most 8 %, otherwise by up to 20 %. O(cells).
void limit_slopes(float* heights, std::size_t rings, const Slope& plane, float max_slope);

}  // namespace pcl_bv::detail
