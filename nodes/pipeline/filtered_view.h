// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The filter stage without the rest of the pipeline, for clouds that are not in memory.
#pragma once

#include <memory>

#include "pcl_bv/nodes/pipeline_config.h"
#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/points/point_source.h"
#include "pcl_bv/segmentation/clusters.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Result of filter_points().
struct FilteredView {
  PointView points;  ///< As many points as the input has; dropped points are NaN.
  Counts counts;     ///< Number of dropped points by reason. All 0 if `owner` is null.
  std::shared_ptr<const PointSource> owner;  ///< Source of `points`; null if `points` is the input.
};

/// Returns a view of `points` that filters the points whenever they are loaded, as FramePipeline does. The
/// input must outlive the view. Makes one pass over the points to count the dropped ones. If the filter keeps
/// all finite points, makes no pass and returns `points` itself, possibly with points that are not finite.
/// `origin` is Frame::recorded_origin. Throws std::invalid_argument if `points` has an index list, and
/// IoError if a region file cannot be read.
FilteredView filter_points(const PointView& points, const FilterConfig& config, const Execution& execution,
                           const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

}  // namespace detail
}  // namespace pcl_bv
