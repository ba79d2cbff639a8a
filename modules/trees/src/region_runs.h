// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>

#include "pcl_bv/kernels/region_states.h"
#include "volume_boxes.h"

namespace pcl_bv {

/// The states of at most kChunkPoints points, as region_states() gives them but for which are unclear, by
/// testing each run of points against those regions only whose boxes it reaches. `boxes` are those of the
/// regions.
void region_states_by_runs(UsableIsa isa, const PointView& points, const RegionTests& regions,
                           const VolumeBoxes& boxes, std::uint8_t* states);

}  // namespace pcl_bv
