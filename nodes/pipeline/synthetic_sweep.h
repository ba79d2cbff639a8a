// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A synthetic sweep for FramePipeline::reserve().
#pragma once

#include <cstddef>

#include "pcl_bv/nodes/frame.h"
#include "pcl_bv/nodes/pipeline_config.h"

namespace pcl_bv {

/// Returns a sweep of `points` points that fits the settings: half of them on level ground around the sensor,
/// half on a hundred objects, two metres wide, on that ground. All points have class 0.
Frame synthetic_sweep(std::size_t points, const PipelineConfig& config);

}  // namespace pcl_bv
