// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Which settings of the pipeline work for clouds in several inputs.
#pragma once

#include <string>

#include "pcl_bv/nodes/pipeline_config.h"

namespace pcl_bv::detail {

/// Returns the setting that does not work for a tiled cloud, or an empty text if all work. Of the methods for
/// the ground, slope works, and only with `allows_ground`.
std::string setting_not_for_tiles(const PipelineConfig& config, bool allows_ground);

}  // namespace pcl_bv::detail
