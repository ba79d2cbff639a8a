// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Parallel passes over the chunks of a cloud. Most passes of the fits over a cloud use map_chunks().
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "pcl_bv/parallel/for_each_chunk.h"
#include "pcl_bv/points/point_source.h"

namespace pcl_bv::detail {

/// Calls merge(map(chunk)) for each chunk of the points. The calls of map() run in parallel, each under a
/// FloatEnvironment. The calls of merge() are in the order of the chunks. At most `max_pending` results exist
/// at a time, so memory is bounded for clouds of any size. A cloud of one chunk is processed without
/// allocation and in the caller's FloatEnvironment. This saves time, because the clusters of a sweep are
/// thousands of such clouds.
template <typename Partial, std::size_t max_pending = 256, typename Map, typename Merge>
void map_chunks(const PointView& points, const ParallelPolicy& policy, Map&& map, Merge&& merge) {
  const std::size_t chunks = chunk_count(points.count);
  if (chunks <= 1) {
    if (chunks == 1) merge(map(load_chunk(points, 0).view()));
    return;
  }
  std::vector<Partial> partials(std::min(chunks, max_pending));
  for (std::size_t first = 0; first < chunks; first += max_pending) {
    const std::size_t count = std::min(max_pending, chunks - first);
    for_each_chunk(policy, count, [&](std::size_t chunk) {
      partials[chunk] = map(load_chunk(points, first + chunk).view());
    });
    for (std::size_t chunk = 0; chunk < count; ++chunk)
      merge(std::move(partials[chunk]));
  }
}

}  // namespace pcl_bv::detail
