// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What files of KITTI's labels need.
#pragma once

#include <string>

#include "pcl_bv/nodes/pipeline_config.h"

namespace pcl_bv::detail {

/// Throws UsageError, which begins with `option`, if the settings make no boxes that KITTI's labels can have:
/// with a rotation only about z.
void check_kitti_boxes(const std::string& option, const PipelineConfig& config);

}  // namespace pcl_bv::detail
