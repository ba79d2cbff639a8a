// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// k-DOPs: the paper's direction sets by the kernels, any other set point by point.

#include <optional>

#include "pcl_bv/fitting/extremes.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/kernels/float_environment.h"
#include "span.h"

namespace pcl_bv {
namespace {

std::optional<DirectionSet> direction_set(const std::shared_ptr<const KdopSet>& set) {
  if (set == KdopSet::dop6()) return DirectionSet::dop6;
  if (set == KdopSet::dop14()) return DirectionSet::dop14;
  if (set == KdopSet::dop18()) return DirectionSet::dop18;
  if (set == KdopSet::dop26()) return DirectionSet::dop26;
  return std::nullopt;
}

EstimationResult fit_point_by_point(const PointView& points, const std::shared_ptr<const KdopSet>& set,
                                    Kdop& kdop) {
  const FloatEnvironment environment;
  EstimationResult result;
  kdop = Kdop(set);
  for (std::size_t i = 0; i < points.count; ++i) {
    const Coordinates p = load_point(points, i);
    if (!is_valid(p)) continue;
    kdop.extend({p.x, p.y, p.z});
    ++result.used;
  }
  result.dropped = points.count - result.used;
  if (result.used == 0) return result;
  Span flat;  // exact only where the slabs are
  for (std::size_t k = 0; k < kdop.size(); ++k) {
    if (kdop.min(k) == kdop.max(k)) flat.add(set->direction(k));
  }
  result.rank = 3 - flat.dimensions();
  result.status = result.rank == 3 ? EstimationStatus::ok : EstimationStatus::degenerate;
  return result;
}

}  // namespace

EstimationResult fit_kdop(const PointView& points, const std::shared_ptr<const KdopSet>& set, Kdop& kdop,
                          const Execution& execution) {
  const std::optional<DirectionSet> directions = direction_set(set);
  if (!directions) return fit_point_by_point(points, set, kdop);
  const Extremes extremes = find_extremes(points, *directions, ExtremeDetail::bounds, execution);
  kdop = kdop_of(extremes);
  return result_of(extremes);
}

}  // namespace pcl_bv
