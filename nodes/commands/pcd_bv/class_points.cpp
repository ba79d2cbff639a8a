// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "class_points.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <mutex>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "pcl_bv/parallel/for_each_chunk.h"
#include "pipeline/kept_points.h"

namespace pcl_bv::detail {
namespace {

// Calls visit(point, class, number) for the valid points of a chunk.
template <typename Visit>
void visit_chunk(const ClassifiedPoints& cloud, std::size_t chunk, const Visit& visit) {
  const LoadedPoints part = load_chunk(cloud.points, chunk);
  const std::size_t first = chunk * kChunkPoints;
  std::vector<std::int64_t> values;
  cloud.tiles.load_integers(cloud.field, first, part.view().count, values);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Coordinates p = load_point(part.view(), i);
    if (is_valid(p)) visit(p, values[i], first + i);
  }
}

// The bits of coordinates, and a class.
struct Key {
  std::uint64_t x, y, z;
  std::int64_t value;

  explicit Key(const ClassPoint& p)
      : x(std::bit_cast<std::uint64_t>(p.at.x)),
        y(std::bit_cast<std::uint64_t>(p.at.y)),
        z(std::bit_cast<std::uint64_t>(p.at.z)),
        value(p.value) {}
  bool operator==(const Key& other) const = default;
};

struct HashKey {
  std::size_t operator()(const Key& key) const {
    std::uint64_t hash = static_cast<std::uint64_t>(key.value);
    for (const std::uint64_t bits : {key.x, key.y, key.z})
      hash = (hash ^ hash >> 29U ^ bits) * 0x9e3779b97f4a7c15U;
    return hash ^ hash >> 32U;
  }
};

}  // namespace

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
    visit_chunk(cloud, chunk, [&](const Coordinates&, std::int64_t value, std::size_t) { ++counts[value]; });
    const std::lock_guard lock(mutex);
    for (const auto& [value, count] : counts)
      all[value] += count;
  });
  return all;
}

std::vector<std::size_t> first_numbers(const ClassifiedPoints& cloud, const std::vector<ClassPoint>& points,
                                       const ParallelPolicy& policy) {
  std::unordered_map<Key, std::size_t, HashKey> positions;
  for (std::size_t i = 0; i < points.size(); ++i)
    positions.emplace(Key(points[i]), i);
  std::vector<std::size_t> numbers(points.size(), std::numeric_limits<std::size_t>::max());
  std::mutex mutex;
  for_each_chunk(policy, chunk_count(cloud.points.count), [&](std::size_t chunk) {
    std::vector<std::pair<std::size_t, std::size_t>> found;
    visit_chunk(cloud, chunk, [&](const Coordinates& p, std::int64_t value, std::size_t number) {
      const auto at = positions.find(Key({p, value}));
      if (at != positions.end()) found.emplace_back(at->second, number);
    });
    const std::lock_guard lock(mutex);
    for (const auto& [position, number] : found)
      numbers[position] = std::min(numbers[position], number);
  });
  return numbers;
}

}  // namespace pcl_bv::detail
