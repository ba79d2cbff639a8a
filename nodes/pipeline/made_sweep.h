// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>

#include "pcl_bv/nodes/frame.h"
#include "pcl_bv/nodes/pipeline_config.h"

namespace pcl_bv {

/// A sweep of `points` points as the settings expect it: half on level ground around the sensor, half on a
/// hundred objects of two metres on it. All points are in class 0.
Frame made_sweep(std::size_t points, const PipelineConfig& config);

}  // namespace pcl_bv
