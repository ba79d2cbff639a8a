// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tiled_settings.h"

#include <cstddef>
#include <limits>

namespace pcl_bv::detail {

std::string setting_not_for_tiles(const PipelineConfig& config, bool allows_ground) {
  const bool ground = config.ground.method != GroundMethod::none;
  const std::size_t unlimited = std::numeric_limits<std::size_t>::max();
  if (ground && !allows_ground) return "--ground (ground.method)";
  if (ground && config.ground.method != GroundMethod::slope)
    return "--ground plane or zones (ground.method), only with --ground slope";
  if (config.cluster.tolerance > 0) {
    if (config.cluster.tolerance_per_metre > 0) return "a tolerance that grows with range";
    if (config.cluster.oversized == Oversized::split) return "--oversized split";
    if (config.track.enabled) return "track.enabled";
    if (config.effective_refine() != Refine::off) return "cluster.refine";
  } else {
    if (config.cluster.effective_min_size() > 0 || config.cluster.max_size < unlimited)
      return "cluster.min_size or max_size";
  }
  return "";
}

}  // namespace pcl_bv::detail
