// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The moments ride on the search for extremes, chunk by chunk.

#include "pcl_bv/fitting/summary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "extreme_search.h"
#include "map_chunks.h"
#include "pcl_bv/kernels/axis_extents.h"
#include "pcl_bv/kernels/moments.h"
#include "pcl_bv/kernels/point_source.h"
#include "local_frame.h"
#include "point_rank.h"
#include "schedule.h"
#include "summarize_bounds.h"

namespace pcl_bv {
namespace {

// What a chunk gives; the extremes are those of a search, or the box alone.
template <typename Found>
struct Part {
  Found extremes;
  Moments moments;
};

void merge_bounds(const AxisExtents& part, Extremes& all) {
  all.dropped += part.dropped;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    all.low[axis] = std::min(all.low[axis], part.low[axis]);
    all.high[axis] = std::max(all.high[axis], part.high[axis]);
  }
}

void merge_moments(const Moments& part, Moments& all) {
  all.count += part.count;
  for (std::size_t k = 0; k < 3; ++k)
    all.sum[k] += part.sum[k];
  for (std::size_t k = 0; k < 6; ++k)
    all.product[k] += part.product[k];
}

// 1, or for tiny extents the power of two that brings the greatest to about 1 (2^1000 is far enough, and
// finite).
double scale_for(const Extremes& extremes) {
  const double extent = widest_side(extremes);
  return extent == 0 || extent >= 1e-100 ? 1 : std::ldexp(1.0, std::min(-std::ilogb(extent), 1000));
}

// A second pass for such clouds, on a copy: (p - origin) scale is as exact as p - origin. A point that is not
// valid differs from a valid one by 1e84 at least, so it stays one that is not.
Moments scaled_moments(const PointView& points, const Coordinates& origin, double scale, Isa isa) {
  Moments all;
  std::vector<double> xyz;
  for (std::size_t chunk = 0; chunk < chunk_count(points.count); ++chunk) {
    const LoadedPoints loaded = load_chunk(points, chunk);
    const PointView& part = loaded.view();
    xyz.clear();
    for (std::size_t i = 0; i < part.count; ++i) {
      const Coordinates p = load_point(part, i);
      xyz.insert(xyz.end(), {(p.x - origin.x) * scale, (p.y - origin.y) * scale, (p.z - origin.z) * scale});
    }
    Moments moments;
    chunk_moments(isa, PointView::of(xyz.data(), 3 * sizeof(double), part.count), {0, 0, 0}, moments);
    merge_moments(moments, all);
  }
  return all;
}

void finish(const Moments& moments, const Coordinates& origin, CloudSummary& summary) {
  const double n = static_cast<double>(moments.count);
  const double from[3] = {origin.x, origin.y, origin.z};
  double mean[3];
  for (int axis = 0; axis < 3; ++axis) {
    mean[axis] = moments.sum[axis] / n;
    summary.centroid[axis] = std::clamp(from[axis] + mean[axis] / summary.scale, summary.extremes.low[axis],
                                        summary.extremes.high[axis]) +
                             0.0;
  }
  std::size_t k = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j, ++k) {
      const double value = moments.product[k] / n - mean[i] * mean[j];
      summary.covariance(i, j) = summary.covariance(j, i) = i == j ? std::max(value, 0.0) : value;
    }
  }
}

// One pass: search(chunk) and the moments of the chunk, merge(found, extremes) in order.
template <typename Found, typename Search, typename Merge>
Moments pass(const PointView& points, const Execution& execution, double seconds, const Coordinates& origin,
             Search&& search, const Merge& merge) {
  const Isa isa = resolve_isa(execution.isa);
  Moments moments;
  map_chunks<Part<Found>>(
      points, worthwhile(execution.parallel, seconds),
      [&](const PointView& chunk) {
        Part<Found> part;
        part.extremes = search(chunk);
        chunk_moments(isa, chunk, origin, part.moments);
        return part;
      },
      [&](const Part<Found>& part) {
        merge(part.extremes);
        merge_moments(part.moments, moments);
      });
  return moments;
}

void finish(const PointView& points, const Execution& execution, const Coordinates& origin, Moments moments,
            CloudSummary& summary) {
  summary.extremes.rank = point_rank(points, summary.extremes, execution);
  summary.scale = scale_for(summary.extremes);
  if (summary.scale != 1) moments = scaled_moments(points, origin, summary.scale, resolve_isa(execution.isa));
  finish(moments, origin, summary);
}

}  // namespace

std::optional<Coordinates> first_valid(const PointView& points) {
  for (std::size_t chunk = 0; chunk < chunk_count(points.count); ++chunk) {
    const LoadedPoints loaded = load_chunk(points, chunk);
    for (std::size_t i = 0; i < loaded.view().count; ++i) {
      const Coordinates p = load_point(loaded.view(), i);
      if (is_valid(p)) return p;
    }
  }
  return std::nullopt;
}

CloudSummary summarize(const PointView& points, const Execution& execution) {
  const FloatEnvironment environment;
  const Isa isa = resolve_isa(execution.isa);
  CloudSummary summary;
  summary.extremes.set = DirectionSet::dop26;
  const std::optional<Coordinates> origin = first_valid(points);
  if (!origin) {
    summary.extremes.dropped = points.count;
    return summary;
  }
  ExtremeSearch search(isa, DirectionSet::dop26, points.count);
  // Moments cost about as much again as the extremes.
  const double seconds = 2 * search_seconds(isa, DirectionSet::dop26, points.count);
  const Moments moments =
      pass<ChunkExtremes>(points, execution, seconds, *origin, search,
                          [&](const ChunkExtremes& found) { merge_extremes(found, summary.extremes); });
  finish_extremes(points.count, summary.extremes);
  finish(points, execution, *origin, moments, summary);
  return summary;
}

CloudSummary summarize_bounds(const PointView& points, const Execution& execution) {
  const Isa isa = resolve_isa(execution.isa);
  CloudSummary summary;
  summary.extremes.set = DirectionSet::dop6;
  const std::optional<Coordinates> origin = first_valid(points);
  if (!origin) {
    summary.extremes.dropped = points.count;
    return summary;
  }
  summary.extremes.low.fill(std::numeric_limits<double>::infinity());
  summary.extremes.high.fill(-std::numeric_limits<double>::infinity());
  // Moments cost about as much as a 26-DOP, the box next to nothing.
  const double seconds = search_seconds(isa, DirectionSet::dop26, points.count);
  const Moments moments = pass<AxisExtents>(
      points, execution, seconds, *origin, [isa](const PointView& chunk) { return axis_extents(isa, chunk); },
      [&](const AxisExtents& found) { merge_bounds(found, summary.extremes); });
  summary.extremes.used = points.count - summary.extremes.dropped;
  finish(points, execution, *origin, moments, summary);
  return summary;
}

}  // namespace pcl_bv
