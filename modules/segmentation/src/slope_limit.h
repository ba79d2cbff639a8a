// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>

#include "zone_points.h"

namespace pcl_bv {

/// Lowers the heights of the first `rings` rings of cells over `plane`, metres, to the highest that climb
/// nowhere more than `max_slope` (a tangent) against the level: a bank is not climbed, from whichever side.
/// Ways between cells go from cell to cell (Borgefors 1986), at most 8 % longer than the straight ones where
/// cells are as wide as long, and up to a fifth longer where they are not. O(cells).
void limit_slopes(float* heights, std::size_t rings, const Slope& plane, float max_slope);

}  // namespace pcl_bv
