// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Taking the ground away, by the method that a configuration names.
#pragma once

#include "pcl_bv/nodes/pipeline_config.h"
#include "pcl_bv/segmentation/ground_zones.h"

namespace pcl_bv {

/// Fewer points say nothing about settings.
inline constexpr std::size_t kFewPoints = 100;

/// One plane's settings as the configuration says.
GroundPlaneSettings plane_settings(const GroundConfig& config);

/// Replaces `split`; without a method nothing is ground and nothing is listed. Zones begin at `sensor`; its
/// height is ignored if that place is estimated. Reuses what `zones` holds.
void split_ground(const PointView& points, const GroundConfig& config, const SensorPlace& sensor,
                  const ParallelPolicy& policy, GroundZones& zones, GroundSplit& split);

}  // namespace pcl_bv
