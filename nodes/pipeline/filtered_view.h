// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The filter stage of the pipeline alone, for clouds that are not in memory.
#pragma once

#include <memory>

#include "pcl_bv/fitting/execution.h"
#include "pcl_bv/nodes/pipeline_config.h"
#include "pcl_bv/points/point_source.h"
#include "pcl_bv/segmentation/counts.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Result of filter_points().
struct FilteredView {
  PointView points;  ///< As many as the input; dropped points are NaN.
  Counts counts;     ///< Number of dropped points by reason; all 0 if the filter keeps every point.
  std::shared_ptr<const PointSource> owner;  ///< Source of `points`; null if they are the input.
};

/// Returns a view of `points` that filters them as FramePipeline does, whenever they are loaded. The view
/// refers to the input, which must outlive it. The function makes one pass over the points to count those
/// that are dropped, or none if the filter keeps all. Throws std::invalid_argument for an index list, and
/// IoError if a region file cannot be read.
FilteredView filter_points(const PointView& points, const FilterConfig& config, const Execution& execution);

}  // namespace pcl_bv
