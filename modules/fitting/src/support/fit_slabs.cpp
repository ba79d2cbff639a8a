// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <optional>

#include "pcl_bv/fitting/fit_into.h"
#include "pcl_bv/fitting/supports.h"
#include "pcl_bv/volumes/kdop_sets.h"

namespace pcl_bv::detail {
namespace {

std::optional<DirectionSet> direction_set(const std::shared_ptr<const KdopSet>& set) {
  for (const auto built_in :
       {DirectionSet::dop6, DirectionSet::dop14, DirectionSet::dop18, DirectionSet::dop26}) {
    if (set == kdop_set_of(built_in)) return built_in;
  }
  return std::nullopt;
}

EstimationResult fit_built_in(const PointView& points, DirectionSet directions,
                              const std::shared_ptr<const KdopSet>& set, Kdop& kdop, SlabPoints* touching,
                              const FitExecution& execution) {
  const SupportDetail detail = touching != nullptr ? SupportDetail::points : SupportDetail::bounds;
  const Supports supports = find_supports(points, directions, detail, execution);
  kdop = kdop_of(supports);
  for (std::size_t k = 0; touching != nullptr && supports.used > 0 && k < set->size(); ++k) {
    touching->min.push_back(supports.along[k].low_point.index);
    touching->max.push_back(supports.along[k].high_point.index);
  }
  return result_of(supports);
}

EstimationResult fit_custom(const PointView& points, const std::shared_ptr<const KdopSet>& set, Kdop& kdop,
                            SlabPoints* touching, const FitExecution& execution) {
  std::vector<std::array<double, 3>> directions;
  for (std::size_t k = 0; k < set->size(); ++k)
    directions.push_back({set->direction(k).x(), set->direction(k).y(), set->direction(k).z()});
  const CustomSupports supports = find_supports(points, directions, execution);
  SlabVector low = kdop.min(), high = kdop.max();
  for (std::size_t k = 0; k < supports.along.size(); ++k) {
    const Support& along = supports.along[k];
    low[static_cast<Eigen::Index>(k)] = along.low;
    high[static_cast<Eigen::Index>(k)] = along.high;
    if (touching == nullptr) continue;
    touching->min.push_back(along.low_point.index);
    touching->max.push_back(along.high_point.index);
  }
  kdop = Kdop(set, low, high);
  return result_of(find_supports(points, DirectionSet::dop6, SupportDetail::bounds, execution));
}

}  // namespace

EstimationResult fit_aabb(const PointView& points, Aabb& box, const FitExecution& execution) {
  std::optional<Supports> own;
  const Supports& supports = find_box(points, execution, own);
  box = aabb_of(supports);
  return result_of(supports);
}

EstimationResult fit_kdop(const PointView& points, const std::shared_ptr<const KdopSet>& set, Kdop& kdop,
                          SlabPoints* touching, const FitExecution& execution) {
  if (touching != nullptr) *touching = SlabPoints();
  kdop = Kdop(set);
  const std::optional<DirectionSet> directions = direction_set(set);
  return directions ? fit_built_in(points, *directions, set, kdop, touching, execution)
                    : fit_custom(points, set, kdop, touching, execution);
}

}  // namespace pcl_bv::detail
