// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What the fits on hull vertices have in common.
#pragma once

#include "local_hull.h"
#include "pcl_bv/fitting/result.h"
#include "pcl_bv/numeric/float_environment.h"

namespace pcl_bv {

/// Calls fit(hull, frame) if there is a valid point; status and rank are the hull's.
template <typename Fit>
EstimationResult fit_round(const PointView& points, const Execution& execution, const Fit& fit) {
  const FloatEnvironment environment;
  const Extremes extremes = find_extremes(points, DirectionSet::dop26, ExtremeDetail::points, execution);
  EstimationResult result = result_of(extremes);
  if (extremes.used == 0) return result;
  const LocalFrame frame(points, extremes);
  const LocalHull hull = local_hull(points, extremes, frame, execution);
  fit(hull, frame);
  result.rank = hull.rank;
  result.status = hull.rank == 3 ? EstimationStatus::ok : EstimationStatus::degenerate;
  return result;
}

}  // namespace pcl_bv
