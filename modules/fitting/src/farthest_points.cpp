// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Chunks over the cores, merged exactly.

#include "farthest_points.h"

#include <limits>

#include "map_chunks.h"
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

}  // namespace

ChunkFarthest find_farthest(const PointView& points, const ProjectionSet& set, const Execution& execution) {
  const Isa isa = resolve_isa(execution.isa);
  ChunkFarthest all;
  if (chunk_count(points.count) <= 1) {  // 5 kB need not be copied for 300 points
    ReachedProjections nothing;
    nothing.fill(-std::numeric_limits<double>::infinity());
    chunk_farthest(isa, points, set, nothing, all);
    return all;
  }
  SharedReach<kMaxProjectionEnds> reach;
  const auto find = [&](const PointView& chunk) {
    ChunkFarthest farthest;
    chunk_farthest(isa, chunk, set, reach.snapshot(), farthest);
    for (std::size_t end = 0; end < 2 * set.count; ++end) {
      const FarthestPoint& point = farthest.ends[end];
      if (point.found) reach.raise(end, surely_reached(set, end, point.point));
    }
    return farthest;
  };
  const auto merge = [&](const ChunkFarthest& part) {
    all.dropped += part.dropped;
    for (std::size_t end = 0; end < 2 * set.count; ++end)
      keep_farthest(set.end_direction(end), part.ends[end], all.ends[end]);
  };
  const double seconds = serial_seconds(isa, set.count, points.count);
  map_chunks<ChunkFarthest>(points, worthwhile(execution.parallel, seconds), find, merge);
  return all;
}

}  // namespace pcl_bv
