// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// find_extreme_points() for those who keep directions and results on the stack: fits of clusters allocate
// nothing.
#pragma once

#include <cstddef>

#include "pcl_bv/fitting/execution.h"
#include "pcl_bv/fitting/extreme_points.h"
#include "pcl_bv/kernels/projections.h"

namespace pcl_bv {

struct ProjectionSearch {
  ProjectionSet set;
  ChunkFarthest farthest;  ///< Of the whole cloud.

  /// Along the k-th direction; of a cloud with a valid point.
  DirectionExtremes along(std::size_t k) const;
};

/// Same rules and errors as find_extreme_points().
ProjectionSearch search_projections(const PointView& points, const Direction* directions, std::size_t count,
                                    const Execution& execution);

}  // namespace pcl_bv
