// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The pipeline's filter alone, for clouds that are not in memory.
#pragma once

#include <memory>

#include "pcl_bv/fitting/execution.h"
#include "pcl_bv/nodes/pipeline_config.h"
#include "pcl_bv/points/point_source.h"
#include "pcl_bv/segmentation/counts.h"

namespace [[gnu::visibility("default")]] pcl_bv {

struct FilteredView {
  PointView points;  ///< As many as before: those that are dropped are not valid (NaN).
  Counts counts;     ///< Of those dropped; nothing if the filter keeps all.
  std::shared_ptr<const PointSource> owner;  ///< Of `points`, if they are not those that came.
};

/// Views `points`, filtered as FramePipeline does, as they come past. A pass over them counts what is
/// dropped; none if the filter keeps all. Throws std::invalid_argument for an index list, and IoError for a
/// file of regions that cannot be read.
FilteredView filter_points(const PointView& points, const FilterConfig& config, const Execution& execution);

}  // namespace pcl_bv
