// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Chunks over the cores, merged exactly.

#include "pcl_bv/fitting/extremes.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <vector>

#include "pcl_bv/kernels/axis_extents.h"
#include "pcl_bv/kernels/chunks.h"
#include "pcl_bv/kernels/extremes.h"
#include "pcl_bv/kernels/float_environment.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "schedule.h"
#include "span.h"

namespace pcl_bv {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

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

double points_seconds(Isa isa, DirectionSet set, std::size_t points) {
  const double per_direction = point_cost(isa).dop26 * 1e-9 / 13.0;
  return per_direction * static_cast<double>(direction_count(set)) * static_cast<double>(points);
}

// One partial result per chunk; small clouds, of which there are many in a sweep, need no allocation.
template <typename Partial, typename Map, typename Merge>
void map_chunks(const PointView& points, const ParallelPolicy& policy, Map&& map, Merge&& merge) {
  const std::size_t chunks = chunk_count(points.count);
  if (chunks <= 1) {
    if (chunks == 1) merge(map(points));
    return;
  }
  std::vector<Partial> partials(chunks);
  for_each_chunk(policy, chunks, [&](std::size_t chunk) {
    const FloatEnvironment environment;
    partials[chunk] = map(chunk_of(points, chunk));
  });
  for (const Partial& partial : partials)
    merge(partial);
}

// What all chunks so far are known to reach. Which chunk sees what depends on timing; the result does not.
class SharedReach {
 public:
  SharedReach() {
    for (std::atomic<double>& r : reached_)
      r.store(-kInfinity, std::memory_order_relaxed);
  }

  ReachedEnds snapshot() const {
    ReachedEnds out;
    for (std::size_t end = 0; end < kMaxEnds; ++end)
      out[end] = reached_[end].load(std::memory_order_relaxed);
    return out;
  }

  void raise(const ChunkExtremes& extremes) {
    for (std::size_t end = 0; end < kMaxEnds; ++end) {
      if (!extremes.ends[end].found) continue;
      const double reach = round_down(extremes.ends[end].projection);
      double known = reached_[end].load(std::memory_order_relaxed);
      while (known < reach && !reached_[end].compare_exchange_weak(known, reach, std::memory_order_relaxed)) {
      }
    }
  }

 private:
  std::array<std::atomic<double>, kMaxEnds> reached_;
};

void find_bounds(const PointView& points, const Execution& execution, Isa isa, Extremes& out) {
  out.low.fill(kInfinity);
  out.high.fill(-kInfinity);
  const ParallelPolicy policy =
      worthwhile(execution.parallel, point_cost(isa).box * 1e-9 * static_cast<double>(points.count));
  map_chunks<AxisExtents>(
      points, policy, [&](const PointView& chunk) { return axis_extents(isa, chunk); },
      [&](const AxisExtents& part) {
        out.dropped += part.dropped;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          out.low[axis] = std::min(out.low[axis], part.low[axis]);
          out.high[axis] = std::max(out.high[axis], part.high[axis]);
        }
      });
  for (std::size_t axis = 0; axis < 3; ++axis)
    out.constant[axis] = out.low[axis] == out.high[axis];
}

void find_points(const PointView& points, const Execution& execution, Isa isa, Extremes& out) {
  SharedReach reach;
  const bool shared = chunk_count(points.count) > 1;
  const auto find = [&](const PointView& chunk) {
    ChunkExtremes extremes;
    chunk_extremes(isa, chunk, out.set, shared ? reach.snapshot() : nothing_reached(), extremes);
    if (shared) reach.raise(extremes);
    return extremes;
  };
  const auto merge = [&](const ChunkExtremes& part) {
    out.dropped += part.dropped;
    for (std::size_t k = 0; k < direction_count(out.set); ++k) {
      keep_extreme(part.ends[2 * k], out.low_point[k]);
      keep_extreme(part.ends[2 * k + 1], out.high_point[k]);
    }
  };
  map_chunks<ChunkExtremes>(
      points, worthwhile(execution.parallel, points_seconds(isa, out.set, points.count)), find, merge);
  for (std::size_t k = 0; k < direction_count(out.set) && out.dropped < points.count; ++k) {
    const ExactSum& low = out.low_point[k].projection;  // of the opposite direction
    const ExactSum& high = out.high_point[k].projection;
    out.low[k] = -round_up(low) + 0.0;
    out.high[k] = round_up(high);
    out.constant[k] = compare({-low.head, -low.tail, -low.rest}, high) == 0;
  }
}

}  // namespace

Extremes find_extremes(const PointView& points, DirectionSet set, ExtremeDetail detail,
                       const Execution& execution) {
  const FloatEnvironment environment;
  const Isa isa = resolve_isa(execution.isa);
  Extremes extremes;
  extremes.set = set;
  if (set == DirectionSet::dop6 && detail == ExtremeDetail::bounds) {
    find_bounds(points, execution, isa, extremes);
  } else {
    find_points(points, execution, isa, extremes);
  }
  extremes.used = points.count - extremes.dropped;
  return extremes;
}

EstimationResult result_of(const Extremes& extremes) {
  EstimationResult result;
  result.used = extremes.used;
  result.dropped = extremes.dropped;
  if (extremes.used == 0) return result;
  Span flat;
  for (std::size_t k = 0; k < direction_count(extremes.set); ++k) {
    const auto& d = kCubeDirections[cube_direction(extremes.set, k)];
    if (extremes.constant[k]) flat.add(Eigen::Vector3d(d[0], d[1], d[2]));
  }
  result.rank = 3 - flat.dimensions();
  result.status = result.rank == 3 ? EstimationStatus::ok : EstimationStatus::degenerate;
  return result;
}

}  // namespace pcl_bv
