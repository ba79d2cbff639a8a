// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "summary.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "local_frame.h"
#include "map_chunks.h"
#include "moment_tree.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/kernels/moments.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/points/point_source.h"
#include "point_rank.h"
#include "same_points.h"
#include "schedule.h"
#include "support/support_search.h"

namespace pcl_bv::detail {
namespace {

// Results of one chunk. `Found` is the type of the supports: ChunkSupports, AxisExtents for a box only, or an
// empty class if the supports are known already.
template <typename Found>
struct Part {
  Found supports;
  MomentTree moments;
};

// Makes one pass over the points. Calls search(chunk) and computes the moments of each chunk in parallel.
// Calls merge(found) in the order of the chunks. `count` is the amount of work, as for worthwhile(). Returns
// the moments of all points.
template <typename Found, typename Search, typename Merge>
Moments pass(const PointView& points, const FitExecution& execution, std::size_t count, const Search& search,
             const Merge& merge) {
  MomentTree moments;
  std::size_t blocks = 0;
  map_chunks<Part<Found>>(
      points, worthwhile(execution, Work::cube_support, count),
      [&](const PointView& chunk) {
        return Part<Found>{search(chunk), moments_of(execution.isa, chunk, 0)};
      },
      [&](const Part<Found>& part) {
        merge(part.supports);
        moments.append(blocks, part.moments);
        blocks += kChunkPoints / kBlockPoints;
      });
  return moments.total();
}

// Returns the summary of points with these supports and moments.
Summary summary_of(Supports supports, const Moments& moments) {
  const CentroidAndCovariance found = centroid_and_covariance(moments, supports);
  return {found, std::move(supports)};
}

}  // namespace

CentroidAndCovariance centroid_and_covariance(Moments moments, const Supports& supports) {
  CentroidAndCovariance found;
  if (moments.count == 0) return found;
  const double extent = widest_side(supports);
  if (!(extent > 0 && extent < 1e-99)) coarsen(0, moments);
  found.covariance_scale = std::ldexp(1.0, moments.exponent);
  const double n = static_cast<double>(moments.count);
  const double from[3] = {moments.origin.x, moments.origin.y, moments.origin.z};
  double mean[3];
  for (int axis = 0; axis < 3; ++axis) {
    mean[axis] = moments.sum[axis] / n;
    found.centroid[axis] = std::clamp(from[axis] + mean[axis] / found.covariance_scale,
                                      supports.along[axis].low, supports.along[axis].high) +
                           0.0;
  }
  std::size_t k = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j, ++k) {
      const double value = moments.product[k] / n - mean[i] * mean[j];
      found.covariance(i, j) = found.covariance(j, i) = i == j ? std::max(value, 0.0) : value;
    }
  }
  return found;
}

Summary summarize(const PointView& points, const FitExecution& execution) {
  require_matching_supports(points, execution);
  if (represents_cloud(execution)) return summary_of(*execution.supports, *execution.supports->moments);
  constexpr DirectionSet set = DirectionSet::dop26;
  const SupportDirections& directions = SupportDirections::of(set);
  SupportSearch search(execution.isa, directions, points.count);
  // The factor is 2, because the moments take about as much time as the supports.
  const Moments moments = pass<ChunkSupports>(
      points, execution, 2 * directions.count * points.count,
      [&](const PointView& chunk) { return search.find(chunk); },
      [&](const ChunkSupports& found) { search.merge(found); });
  Supports supports = supports_of_search(search, set, points, search.dropped());
  supports.rank = point_rank(points, supports, execution);
  return summary_of(std::move(supports), moments);
}

Summary summarize_bounds(const PointView& points, const FitExecution& execution) {
  require_matching_supports(points, execution);
  if (represents_cloud(execution)) return summary_of(*execution.supports, *execution.supports->moments);
  if (execution.supports != nullptr) {
    struct Nothing {};
    Supports supports = find_supports(points, DirectionSet::dop6, SupportDetail::bounds, execution);
    const Moments moments = pass<Nothing>(
        points, execution, kMaxDirections * points.count, [](const PointView&) { return Nothing(); },
        [](const Nothing&) {});
    require_same_points(moments.count == supports.used);
    return summary_of(std::move(supports), moments);
  }
  Supports supports = empty_bounds(points);
  // The count is that of the supports of a 26-DOP, because the moments take about as much time as these
  // supports. The time of the box is negligible.
  const Moments moments = pass<AxisExtents>(
      points, execution, kMaxDirections * points.count,
      [&](const PointView& chunk) { return axis_extents(execution.isa, chunk); },
      [&](const AxisExtents& found) { merge_bounds(found, supports); });
  finish_bounds(supports);
  supports.rank = point_rank(points, supports, execution);
  return summary_of(std::move(supports), moments);
}

}  // namespace pcl_bv::detail

namespace pcl_bv {

CloudSummary summarize(const PointView& points, const Execution& execution) {
  const FloatEnvironment environment;
  const detail::Summary found = detail::summarize(points, execution);
  CloudSummary summary;
  static_cast<EstimationResult&>(summary) = found.result();
  summary.aabb = aabb_of(found.supports);
  summary.dop26 = kdop_of(found.supports);
  summary.centroid = found.centroid;
  summary.covariance = found.covariance;
  summary.covariance_scale = found.covariance_scale;
  return summary;
}

}  // namespace pcl_bv
