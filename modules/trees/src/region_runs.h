// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Tests points against many regions. Points are tested in runs of consecutive points.
#pragma once

#include <cstdint>

#include "pcl_bv/kernels/region_states.h"
#include "volume_boxes.h"

namespace pcl_bv::detail {

/// Sets the states of at most kChunkPoints points. The states are those of region_states(), except that
/// different points may be `unclear`. Each run of points is tested only against regions whose boxes overlap
/// the box of the run. `boxes` must be the boxes of `regions`.
void region_states_by_runs(UsableIsa isa, const PointView& points, const RegionTests& regions,
                           const VolumeBoxes& boxes, std::uint8_t* states);

}  // namespace pcl_bv::detail
