// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/fitting/supports.h"
#include "pcl_bv/numeric/float_environment.h"

namespace pcl_bv {

EstimationResult fit_aabb(const PointView& points, Aabb& box, const Execution& execution) {
  const FloatEnvironment environment;
  const Supports supports = find_supports(points, DirectionSet::dop6, SupportDetail::bounds, execution);
  box = aabb_of(supports);
  return result_of(supports);
}

}  // namespace pcl_bv
