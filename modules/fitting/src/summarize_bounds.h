// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Computes a cloud summary with only the axis-aligned box. For 300 points it is three times as fast as
// summarize().
#pragma once

#include "pcl_bv/fitting/summary.h"

namespace pcl_bv {

/// Same as summarize(), but the supports are only along dop6 and have no points. Needs a FloatEnvironment.
CloudSummary summarize_bounds(const PointView& points, const Execution& execution);

}  // namespace pcl_bv
