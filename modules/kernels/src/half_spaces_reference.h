// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The specification of half_spaces.h: a plain loop that shares no code with the SIMD path.
#pragma once

#include "pcl_bv/kernels/half_spaces.h"

namespace pcl_bv {

std::size_t list_outside_reference(const PointView& points, const HalfSpaces& inside,
                                   std::uint32_t* positions);

}  // namespace pcl_bv
