// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Chunk by chunk, each on its own.

#include "filtered_points.h"

#include <cstring>

#include "filter.h"
#include "pcl_bv/parallel/for_each_chunk.h"

namespace pcl_bv {
namespace {

template <typename T>
void copy_kept(const PointView& points, const PointFilter& filter, std::byte* to) {
  constexpr T nan = std::numeric_limits<T>::quiet_NaN();
  constexpr T dropped[3] = {nan, nan, nan};
  for (std::size_t i = 0; i < points.count; ++i, to += sizeof dropped) {
    T p[3];
    load_point(points, i, p);
    std::memcpy(to, filter.judge(p).inside ? p : dropped, sizeof p);
  }
}

template <typename T>
Counts count_dropped(const PointView& points, const PointFilter& filter) {
  Counts counts;
  for (std::size_t i = 0; i < points.count; ++i) {
    T p[3];
    load_point(points, i, p);
    const auto [valid, inside] = filter.judge(p);
    counts.nonfinite += !valid;
    counts.range += valid && !inside;
  }
  return counts;
}

}  // namespace

Counts FilteredPoints::count(const ParallelPolicy& policy) const {
  const PointFilter filter(config_);
  const auto count_chunk = [&](std::size_t chunk) {
    const LoadedPoints part = load_chunk(points_, chunk);
    return points_.scalar == ScalarType::float64 ? count_dropped<double>(part.view(), filter)
                                                 : count_dropped<float>(part.view(), filter);
  };
  return reduce_chunks(policy, chunk_count(points_.count), Counts{}, count_chunk,
                       [](Counts& all, const Counts& part) {
                         all.nonfinite += part.nonfinite;
                         all.range += part.range;
                       });
}

PointView FilteredPoints::load(std::size_t first, std::size_t count, std::vector<std::byte>& buffer) const {
  const LoadedPoints part(points_, first, count);
  const std::size_t step = 3 * size_of(points_.scalar);
  if (buffer.size() < count * step) buffer.resize(count * step);
  if (points_.scalar == ScalarType::float64) {
    copy_kept<double>(part.view(), PointFilter(config_), buffer.data());
  } else {
    copy_kept<float>(part.view(), PointFilter(config_), buffer.data());
  }
  PointView view;
  view.data = buffer.data();
  view.stride = view.readable = step;
  view.count = count;
  view.first = first;
  view.scalar = points_.scalar;
  return view;
}

}  // namespace pcl_bv
