// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Taking the ground away, by the method that a configuration names.
#pragma once

#include "pcl_bv/nodes/pipeline_config.h"
#include "pcl_bv/segmentation/ground_zones.h"

namespace pcl_bv {

/// Replaces `split`; without a method nothing is ground and nothing is listed. Reuses what `zones` holds.
void split_ground(const PointView& points, const GroundConfig& config, const ParallelPolicy& policy,
                  GroundZones& zones, GroundSplit& split);

}  // namespace pcl_bv
