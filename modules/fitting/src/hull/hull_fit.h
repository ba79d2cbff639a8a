// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The common part of the fits that are computed from the convex hull.
#pragma once

#include "hull/local_hull.h"
#include "pcl_bv/fitting/fit_into.h"
#include "pcl_bv/fitting/result.h"

namespace pcl_bv::detail {

/// Finds the supports and the convex hull, and calls fit(hull, frame, supports). Without a valid point, fit()
/// is not called. Returns the status, the rank and the counts of the points.
template <typename Fit>
EstimationResult fit_on_hull(const PointView& points, const FitExecution& execution, const Fit& fit) {
  const Supports supports = find_supports(points, DirectionSet::dop26, SupportDetail::points, execution);
  if (supports.used == 0) return result_of(supports);
  const LocalFrame frame(supports);
  const std::shared_ptr<const LocalHull> hull = shared_hull(points, supports, frame, execution);
  fit(*hull, frame, supports);
  return result_of(supports);
}

}  // namespace pcl_bv::detail
