// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/fitting/supports.h"
#include "pcl_bv/volumes/kdop_sets.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "map_chunks.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/float_environment.h"
#include "point_rank.h"
#include "schedule.h"
#include "support/support_search.h"

namespace pcl_bv::detail {
namespace {

// Returns whether `known` has all directions of `set`, with support points if `detail` requires them.
bool holds(const Supports& known, DirectionSet set, SupportDetail detail) {
  const bool directions = known.set == set || known.set == DirectionSet::dop26 || set == DirectionSet::dop6;
  return directions && (known.detail == SupportDetail::points || detail == SupportDetail::bounds);
}

// Returns the supports of `known` along the directions of `set`. holds() must be true for this set.
Supports part_of(const Supports& known, DirectionSet set) {
  Supports part = known;
  if (known.set == set) return part;
  part.set = set;
  part.along = SupportList(direction_count(set));
  for (std::size_t k = 0; k < direction_count(set); ++k)
    part.along[k] = known.along[cube_direction(set, k)];
  return part;
}

Supports find_bounds(const PointView& points, const FitExecution& execution) {
  Supports supports = empty_bounds(points);
  map_chunks<AxisExtents>(
      points, worthwhile(execution, Work::box, points.count),
      [&](const PointView& chunk) { return axis_extents(execution.isa, chunk); },
      [&](const AxisExtents& part) { merge_bounds(part, supports); });
  finish_bounds(supports);
  return supports;
}

Supports find_points(const PointView& points, DirectionSet set, const FitExecution& execution) {
  SupportSearch search(execution.isa, SupportDirections::of(set), points.count);
  search.run(points, execution);
  return supports_of_search(search, set, points, search.dropped());
}

}  // namespace

void require_matching_supports(const PointView& points, const FitExecution& execution) {
  if (execution.supports != nullptr && !same_memory(execution.supports->points, points))
    throw std::invalid_argument("FitExecution::supports were found for other points");
}

void require_all_points(const FitExecution& execution, const char* fit) {
  if (represents_cloud(execution)) refuse_partial(fit);
}

void refuse_partial(std::string_view fit) {
  throw std::invalid_argument(std::string(fit) + " needs all points of a cloud, not partial results");
}

SupportSearch::SupportSearch(UsableIsa isa, const SupportDirections& directions, std::size_t points)
    : isa_(isa), directions_(directions), shared_(chunk_count(points) > 1) {
  for (std::size_t end = 0; end < 2 * directions.count; ++end)
    known_max_[end].store(-kInfinity, std::memory_order_relaxed);
}

ChunkSupports SupportSearch::find(const PointView& chunk) {
  SupportBounds known_max = no_support_bounds();
  for (std::size_t end = 0; shared_ && end < 2 * directions_.count; ++end)
    known_max[end] = known_max_[end].load(std::memory_order_relaxed);
  ChunkSupports found;
  chunk_supports(isa_, chunk, directions_, known_max, found);
  for (std::size_t end = 0; shared_ && end < 2 * directions_.count; ++end) {
    if (!found.supports[end].found) continue;
    const double projection = projection_lower_bound(directions_, end, found.supports[end].point);
    while (known_max[end] < projection &&
           !known_max_[end].compare_exchange_weak(known_max[end], projection, std::memory_order_relaxed)) {
    }
  }
  return found;
}

void SupportSearch::merge(const ChunkSupports& part) {
  all_.dropped += part.dropped;
  for (std::size_t end = 0; end < 2 * directions_.count; ++end)
    keep_larger_projection(directions_.support_direction(end), part.supports[end], all_.supports[end]);
}

void SupportSearch::run(const PointView& points, const FitExecution& execution) {
  const Work work = directions_.cube ? Work::cube_support : Work::custom_support;
  map_chunks<ChunkSupports>(
      points, worthwhile(execution, work, directions_.count * points.count),
      [&](const PointView& chunk) { return find(chunk); }, [&](const ChunkSupports& part) { merge(part); });
}

Support SupportSearch::along(std::size_t k) const {
  return support_between(directions_, k, all_.supports[2 * k], all_.supports[2 * k + 1]);
}

Support support_between(const SupportDirections& directions, std::size_t k, const SupportPoint& low,
                        const SupportPoint& high) {
  const Direction& n = directions.exact[k];
  return {project_down(n, low.point), project_up(n, high.point), low, high};
}

Supports supports_of_search(const SupportSearch& search, DirectionSet set, const PointView& points,
                            std::size_t dropped) {
  Supports supports;
  supports.set = set;
  supports.detail = SupportDetail::points;
  supports.points = points;
  supports.dropped = dropped;
  supports.used = points.count - supports.dropped;
  supports.along = SupportList(direction_count(set));
  for (std::size_t k = 0; k < supports.along.size() && supports.used > 0; ++k)
    supports.along[k] = search.along(k);
  return supports;
}

Supports empty_bounds(const PointView& points) {
  Supports supports;
  supports.points = points;
  for (std::size_t axis = 0; axis < 3; ++axis)
    supports.along[axis] = {kInfinity, -kInfinity, {}, {}};
  return supports;
}

void merge_bounds(const AxisExtents& part, Supports& supports) {
  supports.dropped += part.dropped;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Support& along = supports.along[axis];
    along.low = std::min(along.low, part.low[axis]);
    along.high = std::max(along.high, part.high[axis]);
  }
}

void finish_bounds(Supports& supports) {
  supports.used = supports.points.count - supports.dropped;
  if (supports.used == 0) supports.along = SupportList(supports.along.size());
}

Supports find_supports(const PointView& points, DirectionSet set, SupportDetail detail,
                       const FitExecution& execution) {
  const FloatEnvironment environment;
  require_matching_supports(points, execution);
  if (execution.supports != nullptr && holds(*execution.supports, set, detail))
    return part_of(*execution.supports, set);
  const bool bounds = set == DirectionSet::dop6 && detail == SupportDetail::bounds;
  Supports supports = bounds ? find_bounds(points, execution) : find_points(points, set, execution);
  supports.rank = point_rank(points, supports, execution);
  return supports;
}

const Supports& find_box(const PointView& points, const FitExecution& execution,
                         std::optional<Supports>& own) {
  require_matching_supports(points, execution);
  if (execution.supports != nullptr) return *execution.supports;
  own.emplace(find_supports(points, DirectionSet::dop6, SupportDetail::bounds, execution));
  return *own;
}

Supports find_supports_among(const PointView& points, const std::vector<PointView>& candidates,
                             DirectionSet set, std::size_t dropped, const FitExecution& execution) {
  const FloatEnvironment environment;
  SupportSearch search(execution.isa, SupportDirections::of(set), points.count);
  for (const PointView& part : candidates)
    search.merge(search.find(LoadedPoints(part, 0, part.count).view()));
  Supports supports = supports_of_search(search, set, points, dropped);
  supports.rank = point_rank(points, supports, execution);
  return supports;
}

Supports supports_of_bounds(const PointView& points, const std::array<float, 3>& low,
                            const std::array<float, 3>& high, std::size_t dropped,
                            const FitExecution& execution) {
  const FloatEnvironment environment;
  Supports supports = empty_bounds(points);
  const auto as_double = [](const std::array<float, 3>& p) {
    return std::array<double, 3>{p[0] + 0.0, p[1] + 0.0, p[2] + 0.0};
  };
  merge_bounds({as_double(low), as_double(high), dropped}, supports);
  finish_bounds(supports);
  supports.rank = point_rank(points, supports, execution);
  return supports;
}

CustomSupports find_supports(const PointView& points, const std::vector<std::array<double, 3>>& directions,
                             const FitExecution& execution) {
  const FloatEnvironment environment;
  require_matching_supports(points, execution);
  if (directions.empty()) throw std::invalid_argument("find_supports: no directions");
  SupportDirections set;
  for (const Direction& direction : directions)
    set.add(direction);
  SupportSearch search(execution.isa, set, points.count);
  search.run(points, execution);
  CustomSupports result{points.count - search.dropped(), search.dropped(), {}};
  for (std::size_t k = 0; k < directions.size() && result.used > 0; ++k)
    result.along.push_back(search.along(k));
  return result;
}

Aabb aabb_of(const Supports& supports) {
  if (supports.used == 0) return {};
  const Support &x = supports.along[0], &y = supports.along[1], &z = supports.along[2];
  return {{x.low, y.low, z.low}, {x.high, y.high, z.high}};
}

Kdop kdop_of(const Supports& supports) {
  const std::shared_ptr<const KdopSet>& set = kdop_set_of(supports.set);
  if (supports.used == 0) return Kdop(set);
  SlabVector low(static_cast<Eigen::Index>(set->size())), high = low;
  for (std::size_t k = 0; k < set->size(); ++k) {
    low[static_cast<Eigen::Index>(k)] = supports.along[k].low;
    high[static_cast<Eigen::Index>(k)] = supports.along[k].high;
  }
  return {set, low, high};
}

EstimationResult result_of(const Supports& supports) {
  const EstimationStatus status = supports.used == 0   ? EstimationStatus::no_valid_points
                                  : supports.rank == 3 ? EstimationStatus::ok
                                                       : EstimationStatus::degenerate;
  return {status, supports.rank, supports.used, supports.dropped, {}};
}

}  // namespace pcl_bv::detail
