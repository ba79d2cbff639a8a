// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The first look at a frame.
#pragma once

#include <cstdint>
#include <vector>

#include "pcl_bv/io/report.h"
#include "pcl_bv/kernels/point_view.h"
#include "pcl_bv/nodes/pipeline_config.h"

namespace pcl_bv {

/// Replaces `kept` with the numbers of the valid points in range and outside the own vehicle, in the order of
/// the view; counts the others.
void filter_points(const PointView& points, const FilterConfig& config, std::vector<std::int32_t>& kept,
                   Counts& counts);

}  // namespace pcl_bv
