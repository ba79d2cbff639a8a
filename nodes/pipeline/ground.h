// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Ground removal by the configured method.
#pragma once

#include "pcl_bv/nodes/pipeline_config.h"
#include "pcl_bv/segmentation/ground.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Smallest number of points for which warnings about the ground settings are given.
inline constexpr std::size_t kFewPoints = 100;

/// Returns the settings of split_ground() for one plane.
GroundPlaneOptions plane_settings(const GroundConfig& config);

/// Returns the settings of split_ground_by_slope().
GroundSlopeOptions slope_settings(const GroundConfig& config);

/// Splits the points by the configured method and replaces `split`. With GroundMethod::none, both lists of
/// `split` are empty. Zones are centred at `sensor`. For a plane, the sensor height is that of `origin`. If
/// `sensor` is estimated, the configured sensor height is ignored. Reuses the memory of `zones`.
void split_ground(const PointView& points, const GroundConfig& config, const SensorPosition& sensor,
                  const Eigen::Vector3d& origin, const Execution& execution, GroundZones& zones,
                  GroundSplit& split);

}  // namespace detail
}  // namespace pcl_bv
