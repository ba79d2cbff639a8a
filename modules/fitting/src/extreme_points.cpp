// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Chunks over the cores, merged exactly.

#include "pcl_bv/fitting/extreme_points.h"

#include <stdexcept>

#include "extreme_search.h"
#include "map_chunks.h"
#include "pcl_bv/numeric/float_environment.h"
#include "projection_search.h"
#include "schedule.h"
#include "shared_reach.h"

namespace pcl_bv {
namespace {

// What a point and a direction cost, measured; it decides whether threads are worth starting.
double serial_seconds(Isa isa, std::size_t directions, std::size_t points) {
  const double projection = isa == Isa::scalar   ? 0.9e-9
                            : isa == Isa::avx512 ? 0.05e-9
                            : isa == Isa::avx2   ? 0.08e-9
                                                 : 0.17e-9;
  return projection * static_cast<double>(directions) * static_cast<double>(points);
}

ProjectionSet checked(const Direction* directions, std::size_t count) {
  if (count == 0) throw std::invalid_argument("find_extreme_points: no directions");
  ProjectionSet set;
  for (std::size_t k = 0; k < count; ++k)
    set.add(directions[k]);
  return set;
}

DirectionExtremes extremes_along(const Direction& n, const FarthestPoint& low, const FarthestPoint& high) {
  return {project_down(n, low.point), project_up(n, high.point), low, high};
}

}  // namespace

DirectionExtremes ProjectionSearch::along(std::size_t k) const {
  return extremes_along(set.exact[k], farthest.ends[2 * k], farthest.ends[2 * k + 1]);
}

ProjectionSearch search_projections(const PointView& points, const Direction* directions, std::size_t count,
                                    const Execution& execution) {
  require_own_extremes(points, execution);
  ProjectionSearch search{checked(directions, count), {}};
  const ProjectionSet& set = search.set;
  SharedReach<kMaxProjectionEnds> reach;
  const bool shared = chunk_count(points.count) > 1;
  const auto find = [&](const PointView& chunk) {
    ChunkFarthest farthest;
    chunk_farthest(execution.isa, chunk, set, reach.snapshot(), farthest);
    for (std::size_t end = 0; end < 2 * set.count && shared; ++end) {
      const FarthestPoint& point = farthest.ends[end];
      if (point.found) reach.raise(end, surely_reached(set, end, point.point));
    }
    return farthest;
  };
  const auto merge = [&](const ChunkFarthest& part) {
    search.farthest.dropped += part.dropped;
    for (std::size_t end = 0; end < 2 * set.count; ++end)
      keep_farthest(set.end_direction(end), part.ends[end], search.farthest.ends[end]);
  };
  const double seconds = serial_seconds(execution.isa, set.count, points.count);
  map_chunks<ChunkFarthest>(points, worthwhile(execution.parallel, seconds), find, merge);
  return search;
}

ExtremePoints find_extreme_points(const PointView& points,
                                  const std::vector<std::array<double, 3>>& directions,
                                  const Execution& execution) {
  const FloatEnvironment environment;
  const ProjectionSearch search = search_projections(points, directions.data(), directions.size(), execution);
  const std::size_t dropped = search.farthest.dropped;
  ExtremePoints result{points.count - dropped, dropped, {}};
  for (std::size_t k = 0; k < directions.size() && result.used > 0; ++k)
    result.along.push_back(search.along(k));
  return result;
}

}  // namespace pcl_bv
