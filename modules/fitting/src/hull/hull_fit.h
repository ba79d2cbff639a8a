// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What the fits that need a hull have in common.
#pragma once

#include "hull/local_hull.h"
#include "pcl_bv/fitting/result.h"
#include "pcl_bv/numeric/float_environment.h"

namespace pcl_bv {

/// What is said of points that have this hull: as result_of(supports) unless Qhull found no triangles.
inline EstimationResult result_of(const Supports& supports, const LocalHull& hull) {
  EstimationResult result = result_of(supports);
  if (hull.rank == 3 && hull.triangles.empty()) {
    result.status = EstimationStatus::failed;
    result.reason = "Qhull finds no hull";
  }
  return result;
}

/// Calls fit(hull, frame, supports) if there is a valid point and a hull.
template <typename Fit>
EstimationResult fit_on_hull(const PointView& points, const Execution& execution, const Fit& fit) {
  const FloatEnvironment environment;
  const Supports supports = find_supports(points, DirectionSet::dop26, SupportDetail::points, execution);
  if (supports.used == 0) return result_of(supports);
  const LocalFrame frame(supports);
  const std::shared_ptr<const LocalHull> hull = shared_hull(points, supports, frame, execution);
  const EstimationResult result = result_of(supports, *hull);
  if (result.status != EstimationStatus::failed) fit(*hull, frame, supports);
  return result;
}

}  // namespace pcl_bv
