// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A cloud summary with the axis-aligned box only: three times as fast as summarize() on 300 points.
#pragma once

#include "pcl_bv/fitting/summary.h"

namespace pcl_bv {

/// As summarize(), but with the supports along dop6 only and without support points. Needs a
/// FloatEnvironment.
CloudSummary summarize_bounds(const PointView& points, const Execution& execution);

}  // namespace pcl_bv
