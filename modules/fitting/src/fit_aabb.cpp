// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Boxes: the extremes along three axes are the answer.

#include "pcl_bv/fitting/extremes.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/numeric/float_environment.h"

namespace pcl_bv {

EstimationResult fit_aabb(const PointView& points, Aabb& box, const Execution& execution) {
  const FloatEnvironment environment;
  const Extremes extremes = find_extremes(points, DirectionSet::dop6, ExtremeDetail::bounds, execution);
  box = aabb_of(extremes);
  return result_of(extremes);
}

}  // namespace pcl_bv
