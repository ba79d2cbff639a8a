// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The specification of distances.h: plain loops that share no code with the SIMD path.
#pragma once

#include "pcl_bv/kernels/distances.h"

namespace pcl_bv {

void block_distances_reference(const PointView& points, const DistanceCenter& center, double limit,
                               FloatFilter filter, double* greatest);
void scan_octants_reference(const PointView& block, OctantScan& scan);
std::size_t list_reaching_reference(const PointView& block, const KeptBounds& kept,
                                    const DistanceCenter& center, double limit, std::uint32_t* positions);
std::size_t list_distant_reference(const PointView& points, const DistanceCenter& center, double limit,
                                   FloatFilter filter, std::uint32_t* positions);

}  // namespace pcl_bv
