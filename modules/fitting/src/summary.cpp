// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The moments ride on the search for extremes, chunk by chunk.

#include "pcl_bv/fitting/summary.h"

#include <algorithm>
#include <cmath>

#include "extreme_search.h"
#include "local_frame.h"
#include "map_chunks.h"
#include "moment_tree.h"
#include "pcl_bv/kernels/axis_extents.h"
#include "pcl_bv/kernels/moments.h"
#include "pcl_bv/kernels/point_source.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/float_environment.h"
#include "point_rank.h"
#include "schedule.h"
#include "summarize_bounds.h"

namespace pcl_bv {
namespace {

// What a chunk gives; the extremes are those of a search, or the box alone.
template <typename Found>
struct Part {
  Found extremes;
  MomentTree moments;
};

void merge_bounds(const AxisExtents& part, Extremes& all) {
  all.dropped += part.dropped;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    all.low[axis] = std::min(all.low[axis], part.low[axis]);
    all.high[axis] = std::max(all.high[axis], part.high[axis]);
  }
}

MomentTree moments_of(UsableIsa isa, const PointView& chunk) {
  MomentTree tree;
  for (std::size_t block = 0; block * kBlockPoints < chunk.count; ++block)
    tree.append(block, block_moments(isa, block_of(chunk, block)));
  return tree;
}

void finish(Moments moments, CloudSummary& summary) {
  if (moments.count == 0) return;
  const double extent = widest_side(summary.extremes);
  if (!(extent > 0 && extent < 1e-99)) coarsen(0, moments);
  summary.scale = std::ldexp(1.0, moments.exponent);
  const double n = static_cast<double>(moments.count);
  const double from[3] = {moments.origin.x, moments.origin.y, moments.origin.z};
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

// One pass: search(chunk) and the moments of the chunk, merge(found) in order.
template <typename Found, typename Search, typename Merge>
Moments pass(const PointView& points, const Execution& execution, double seconds, Search&& search,
             const Merge& merge) {
  MomentTree moments;
  std::size_t blocks = 0;
  map_chunks<Part<Found>>(
      points, worthwhile(execution.parallel, seconds),
      [&](const PointView& chunk) {
        return Part<Found>{search(chunk), moments_of(execution.isa, chunk)};
      },
      [&](const Part<Found>& part) {
        merge(part.extremes);
        moments.append(blocks, part.moments);
        blocks += kChunkPoints / kBlockPoints;
      });
  return moments.total();
}

}  // namespace

CloudSummary summarize(const PointView& points, const Execution& execution) {
  const FloatEnvironment environment;
  require_own_extremes(points, execution);
  CloudSummary summary;
  summary.extremes.set = DirectionSet::dop26;
  summary.extremes.points = points;
  ExtremeSearch search(execution.isa, DirectionSet::dop26, points.count);
  // Moments cost about as much again as the extremes.
  const double seconds = 2 * search_seconds(execution.isa, DirectionSet::dop26, points.count);
  const Moments moments =
      pass<ChunkExtremes>(points, execution, seconds, search,
                          [&](const ChunkExtremes& found) { merge_extremes(found, summary.extremes); });
  finish_extremes(points.count, summary.extremes);
  summary.extremes.rank = point_rank(points, summary.extremes, execution);
  finish(moments, summary);
  return summary;
}

CloudSummary summarize_bounds(const PointView& points, const Execution& execution) {
  require_own_extremes(points, execution);
  CloudSummary summary;
  summary.extremes.set = DirectionSet::dop6;
  summary.extremes.points = points;
  summary.extremes.low.fill(kInfinity);
  summary.extremes.high.fill(-kInfinity);
  // Moments cost about as much as a 26-DOP, the box next to nothing.
  const double seconds = search_seconds(execution.isa, DirectionSet::dop26, points.count);
  const Moments moments = pass<AxisExtents>(
      points, execution, seconds, [&](const PointView& chunk) { return axis_extents(execution.isa, chunk); },
      [&](const AxisExtents& found) { merge_bounds(found, summary.extremes); });
  summary.extremes.used = moments.count;
  if (moments.count == 0) summary.extremes.low = summary.extremes.high = {};
  summary.extremes.rank = point_rank(points, summary.extremes, execution);
  finish(moments, summary);
  return summary;
}

}  // namespace pcl_bv
