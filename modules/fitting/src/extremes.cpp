// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Chunks over the cores, merged exactly.

#include "pcl_bv/fitting/extremes.h"

#include <algorithm>
#include <stdexcept>

#include "extreme_search.h"
#include "map_chunks.h"
#include "pcl_bv/kernels/axis_extents.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/float_environment.h"
#include "point_rank.h"
#include "schedule.h"

namespace pcl_bv {
namespace {

// What a point costs from the third-level cache, measured; it decides whether threads are worth starting.
struct PointCost {
  double box, dop26;  // nanoseconds
};

PointCost point_cost(Isa isa) {
  switch (isa) {
    case Isa::scalar:
      return {1.3, 6.5};
    case Isa::avx512:
      return {0.17, 0.33};
    case Isa::avx2:
      return {0.17, 0.75};
    default:
      return {0.27, 1.5};
  }
}

void find_bounds(const PointView& points, const Execution& execution, Extremes& out) {
  out.low.fill(kInfinity);
  out.high.fill(-kInfinity);
  const ParallelPolicy policy = worthwhile(
      execution.parallel, point_cost(execution.isa).box * 1e-9 * static_cast<double>(points.count));
  map_chunks<AxisExtents>(
      points, policy, [&](const PointView& chunk) { return axis_extents(execution.isa, chunk); },
      [&](const AxisExtents& part) {
        out.dropped += part.dropped;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          out.low[axis] = std::min(out.low[axis], part.low[axis]);
          out.high[axis] = std::max(out.high[axis], part.high[axis]);
        }
      });
}

void find_points(const PointView& points, const Execution& execution, Extremes& out) {
  ExtremeSearch search(execution.isa, out.set, points.count);
  map_chunks<ChunkExtremes>(
      points, worthwhile(execution.parallel, search_seconds(execution.isa, out.set, points.count)),
      [&](const PointView& chunk) { return search(chunk); },
      [&](const ChunkExtremes& part) { merge_extremes(part, out); });
}

// Whether all directions of a set are among those that were searched, with what is asked of them.
bool holds(const Extremes& known, DirectionSet set, ExtremeDetail detail) {
  const bool directions = known.set == set || known.set == DirectionSet::dop26 || set == DirectionSet::dop6;
  return directions && (known.detail == ExtremeDetail::points || detail == ExtremeDetail::bounds);
}

// The same with fewer directions.
Extremes part_of(const Extremes& known, DirectionSet set) {
  Extremes part;
  part.set = set;
  part.detail = known.detail;
  part.used = known.used;
  part.dropped = known.dropped;
  part.points = known.points;
  part.rank = known.rank;
  const bool of_all = known.set == DirectionSet::dop26;
  for (std::size_t k = 0; k < direction_count(set); ++k) {
    const std::size_t from = of_all ? cube_direction(set, k) : k;
    part.low[k] = known.low[from];
    part.high[k] = known.high[from];
    part.low_point[k] = known.low_point[from];
    part.high_point[k] = known.high_point[from];
  }
  return part;
}

}  // namespace

void require_own_extremes(const PointView& points, const Execution& execution) {
  if (execution.extremes != nullptr && !same_places(execution.extremes->points, points))
    throw std::invalid_argument("Execution::extremes are those of other points");
}

double search_seconds(Isa isa, DirectionSet set, std::size_t points) {
  const double per_direction = point_cost(isa).dop26 * 1e-9 / 13.0;
  return per_direction * static_cast<double>(direction_count(set)) * static_cast<double>(points);
}

ExtremeSearch::ExtremeSearch(UsableIsa isa, DirectionSet set, std::size_t points)
    : isa_(isa), set_(set), shared_(chunk_count(points) > 1) {}

ChunkExtremes ExtremeSearch::operator()(const PointView& chunk) {
  ChunkExtremes extremes;
  chunk_extremes(isa_, chunk, set_, shared_ ? reach_.snapshot() : nothing_reached(), extremes);
  for (std::size_t end = 0; shared_ && end < kMaxEnds; ++end) {
    if (extremes.ends[end].found) reach_.raise(end, round_down(extremes.ends[end].projection));
  }
  return extremes;
}

void merge_extremes(const ChunkExtremes& part, Extremes& extremes) {
  extremes.dropped += part.dropped;
  for (std::size_t k = 0; k < direction_count(extremes.set); ++k) {
    keep_extreme(part.ends[2 * k], extremes.low_point[k]);
    keep_extreme(part.ends[2 * k + 1], extremes.high_point[k]);
  }
}

void finish_extremes(std::size_t points, Extremes& extremes) {
  extremes.used = points - extremes.dropped;
  for (std::size_t k = 0; k < direction_count(extremes.set) && extremes.used > 0; ++k) {
    extremes.low[k] = -round_up(extremes.low_point[k].projection) + 0.0;  // of the opposite direction
    extremes.high[k] = round_up(extremes.high_point[k].projection);
  }
}

Extremes find_extremes(const PointView& points, DirectionSet set, ExtremeDetail detail,
                       const Execution& execution) {
  const FloatEnvironment environment;
  require_own_extremes(points, execution);
  if (execution.extremes != nullptr && holds(*execution.extremes, set, detail))
    return part_of(*execution.extremes, set);
  Extremes extremes;
  extremes.set = set;
  extremes.detail = detail;
  extremes.points = points;
  if (set == DirectionSet::dop6 && detail == ExtremeDetail::bounds) {
    find_bounds(points, execution, extremes);
    extremes.used = points.count - extremes.dropped;
    if (extremes.used == 0) extremes.low = extremes.high = {};
  } else {
    find_points(points, execution, extremes);
    finish_extremes(points.count, extremes);
  }
  extremes.rank = point_rank(points, extremes, execution);
  return extremes;
}

Aabb aabb_of(const Extremes& extremes) {
  if (extremes.used == 0) return {};
  return {{extremes.low[0], extremes.low[1], extremes.low[2]},
          {extremes.high[0], extremes.high[1], extremes.high[2]}};
}

Kdop kdop_of(const Extremes& extremes) {
  const std::shared_ptr<const KdopSet>& set = KdopSet::of(extremes.set);
  if (extremes.used == 0) return Kdop(set);
  const auto size = static_cast<Eigen::Index>(set->size());
  return {set, Eigen::Map<const Eigen::VectorXd>(extremes.low.data(), size),
          Eigen::Map<const Eigen::VectorXd>(extremes.high.data(), size)};
}

EstimationResult result_of(const Extremes& extremes) {
  const EstimationStatus status = extremes.used == 0   ? EstimationStatus::no_valid_points
                                  : extremes.rank == 3 ? EstimationStatus::ok
                                                       : EstimationStatus::degenerate;
  return {status, extremes.rank, extremes.used, extremes.dropped, {}};
}

}  // namespace pcl_bv
