// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "class_points.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <unordered_map>

#include "pcl_bv/parallel/for_each_chunk.h"
#include "pipeline/kept_points.h"

namespace pcl_bv::detail {
PointView ClassPoints::load(std::size_t first, std::size_t count, std::vector<std::byte>& buffer) const {
  const LoadedPoints part(cloud_.points, first - cloud_.points.first, count);
  std::vector<std::int64_t> values;
  cloud_.tiles.load_integers(cloud_.field, first, count, values);
  return kept_points(
      part.view(), first, [&](std::size_t i) { return values[i] == value_; }, buffer);
}

namespace {

// Returns the number of valid points of each class that has some.
std::map<std::int64_t, std::size_t> count_classes(const ClassifiedPoints& cloud,
                                                  const ParallelPolicy& policy) {
  std::map<std::int64_t, std::size_t> all;
  std::mutex mutex;
  for_each_chunk(policy, chunk_count(cloud.points.count), [&](std::size_t chunk) {
    std::unordered_map<std::int64_t, std::size_t> counts;
    const LoadedPoints part = load_chunk(cloud.points, chunk);
    std::vector<std::int64_t> values;
    cloud.tiles.load_integers(cloud.field, cloud.points.first + chunk * kChunkPoints, part.view().count,
                              values);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (is_valid(load_point(part.view(), i))) ++counts[values[i]];
    const std::lock_guard lock(mutex);
    for (const auto& [value, count] : counts)
      all[value] += count;
  });
  return all;
}

const ClassOptions* own_options(const ClassTable& table, std::int64_t value) {
  const auto own = std::find_if(table.class_options().begin(), table.class_options().end(),
                                [&](const ClassOptions& one) { return one.value == value; });
  return own == table.class_options().end() ? nullptr : &*own;
}

}  // namespace

Classes find_classes(const ClassifiedPoints& cloud, const ClassTable& table, const ParallelPolicy& policy) {
  Classes classes;
  for (const auto& [value, count] : count_classes(cloud, policy)) {
    classes.valid += count;
    const ClassOptions* const own = own_options(table, value);
    if (own != nullptr && own->drop) {
      classes.dropped += count;
    } else {
      classes.kept.emplace_back(value, options_of_class(table, value));
    }
  }
  return classes;
}

ClusterOptions options_of_class(const ClassTable& table, std::optional<std::int64_t> value) {
  const ClassOptions* const own = value ? own_options(table, *value) : nullptr;
  return own != nullptr ? own->clusters : table.default_options();
}

}  // namespace pcl_bv::detail
