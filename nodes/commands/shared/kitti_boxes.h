// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Checks settings for files of KITTI's labels.
#pragma once

#include <string>

#include "pcl_bv/nodes/pipeline_config.h"

namespace pcl_bv::detail {

/// Throws UsageError, which begins with `option`, if no method gives boxes that rotate only about z, as
/// KITTI's labels need.
void check_kitti_boxes(const std::string& option, const PipelineConfig& config);

}  // namespace pcl_bv::detail
