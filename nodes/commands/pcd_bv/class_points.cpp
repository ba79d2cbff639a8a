// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "class_points.h"

#include <mutex>
#include <unordered_map>

#include "pcl_bv/parallel/for_each_chunk.h"
#include "pipeline/kept_points.h"

namespace pcl_bv::detail {
PointView ClassPoints::load(std::size_t first, std::size_t count, std::vector<std::byte>& buffer) const {
  const LoadedPoints part(cloud_.points, first, count);
  std::vector<std::int64_t> values;
  cloud_.tiles.load_integers(cloud_.field, first, count, values);
  return kept_points(
      part.view(), first, [&](std::size_t i) { return values[i] == value_; }, buffer);
}

std::map<std::int64_t, std::size_t> count_classes(const ClassifiedPoints& cloud,
                                                  const ParallelPolicy& policy) {
  std::map<std::int64_t, std::size_t> all;
  std::mutex mutex;
  for_each_chunk(policy, chunk_count(cloud.points.count), [&](std::size_t chunk) {
    std::unordered_map<std::int64_t, std::size_t> counts;
    const LoadedPoints part = load_chunk(cloud.points, chunk);
    std::vector<std::int64_t> values;
    cloud.tiles.load_integers(cloud.field, chunk * kChunkPoints, part.view().count, values);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (is_valid(load_point(part.view(), i))) ++counts[values[i]];
    const std::lock_guard lock(mutex);
    for (const auto& [value, count] : counts)
      all[value] += count;
  });
  return all;
}

}  // namespace pcl_bv::detail
