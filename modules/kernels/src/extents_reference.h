// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The specification of block_extents(): plain loops that share no code with the SIMD path.
#pragma once

#include "pcl_bv/kernels/extents.h"

namespace pcl_bv {

void block_extents_reference(const PointView& points, DirectionSet set, BlockExtents* blocks);

}  // namespace pcl_bv
