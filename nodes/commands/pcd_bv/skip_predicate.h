// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Which nodes of a COPC file need not be decompressed.
#pragma once

#include <optional>
#include <vector>

#include "inputs.h"
#include "options.h"
#include "pcl_bv/io/las.h"
#include "pcl_bv/nodes/frame_pipeline.h"

namespace pcl_bv::detail {

/// Returns a predicate that accepts boxes with only points that the filter drops for the same reason as the
/// centre of the box. So the results and counts are those of all points. `kept_extents` is that of the
/// filter. Margins cover the rounding of distances.
BoxPredicate make_skip_predicate(const FilterConfig& filter,
                                 const std::optional<std::vector<Aabb>>& kept_extents);

/// Returns a predicate that accepts boxes that process() does not need. Returns an empty function if it needs
/// all points: for other files than .laz, for results with points that the filter drops, if the filter keeps
/// most points, if the points are moved or have classes, and if dropped points help to find the sensor, the
/// ground or objects to cut.
BoxPredicate make_skip_predicate(const Job& job, const Options& options, const FramePipeline& pipeline);

}  // namespace pcl_bv::detail
