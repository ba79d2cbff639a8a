// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Ground removal by slope without the rest of the pipeline, for clouds that are not in memory.
#pragma once

#include <cstddef>
#include <memory>

#include "pcl_bv/nodes/pipeline_config.h"
#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/points/point_source.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Result of remove_slope_ground().
struct GroundView {
  PointView points;       ///< As many points as the input has; ground points are NaN.
  std::size_t valid = 0;  ///< Number of valid points of the input.
  std::shared_ptr<const PointSource> owner;  ///< Source of `points`.
};

/// Returns a view of `points` that removes the ground whenever points are loaded, with the same result as
/// split_ground_by_slope(). The input must outlive the view. Makes one pass over the points. Throws
/// std::invalid_argument if `points` has an index list.
GroundView remove_slope_ground(const PointView& points, const GroundConfig& config,
                               const Execution& execution);

}  // namespace detail
}  // namespace pcl_bv
