// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The specification of slab_extents.h: a plain loop that shares no code with the SIMD path.
#pragma once

#include "pcl_bv/kernels/slab_extents.h"

namespace pcl_bv {

SlabExtents slab_extents_reference(const PointView& points, const Coordinates& origin,
                                   const std::array<Direction, 3>& axes);

}  // namespace pcl_bv
