// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Tests points against many regions. Regions far from a run of consecutive points are skipped.
#pragma once

#include <cstdint>

#include "pcl_bv/kernels/region_states.h"
#include "volume_boxes.h"

namespace pcl_bv::detail {

/// Sets the states of at most kChunkPoints points. The states are those of region_states(), except that the
/// set of `unclear` points may differ. If this is cheaper, each run of points is tested only against the
/// regions whose boxes overlap the box of the run, and the points may be sorted first. `boxes` must be the
/// boxes of `regions`.
void region_states_by_runs(UsableIsa isa, const PointView& points, const RegionTests& regions,
                           const VolumeBoxes& boxes, std::uint8_t* states);

}  // namespace pcl_bv::detail
