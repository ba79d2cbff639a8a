// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A synthetic sweep for FramePipeline::reserve().
#pragma once

#include <cstddef>

#include "pcl_bv/nodes/frame.h"
#include "pcl_bv/nodes/pipeline_config.h"

namespace pcl_bv::detail {

/// Returns a sweep of `points` points that fits the settings. Half of them are on level ground around the
/// sensor. The other half are on a hundred objects on that ground, each two metres wide. All points have
/// class 0.
Frame synthetic_sweep(std::size_t points, const PipelineConfig& config);

}  // namespace pcl_bv::detail
