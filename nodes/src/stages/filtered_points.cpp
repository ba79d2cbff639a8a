// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "filtered_points.h"

#include <cstring>
#include <limits>

#include "pcl_bv/parallel/for_each_chunk.h"

namespace pcl_bv {
namespace {

template <typename T>
void copy_kept(const PointView& points, const std::vector<Verdict>& verdicts, std::byte* to) {
  constexpr T nan = std::numeric_limits<T>::quiet_NaN();
  constexpr T dropped[3] = {nan, nan, nan};
  for (std::size_t i = 0; i < points.count; ++i, to += sizeof dropped) {
    T p[3];
    load_point(points, i, p);
    std::memcpy(to, verdicts[i] == Verdict::kept ? p : dropped, sizeof p);
  }
}

}  // namespace

Counts FilteredPoints::count(const ParallelPolicy& policy) const {
  const auto count_chunk = [&](std::size_t chunk) {
    FilterScratch scratch;
    filter_->judge(load_chunk(points_, chunk).view(), scratch);
    Counts counts;
    count_verdicts(scratch.verdicts, counts);
    return counts;
  };
  return reduce_chunks(policy, chunk_count(points_.count), Counts{}, count_chunk,
                       [](Counts& all, const Counts& part) {
                         all.nonfinite += part.nonfinite;
                         all.range += part.range;
                         all.inside += part.inside;
                       });
}

PointView FilteredPoints::load(std::size_t first, std::size_t count, std::vector<std::byte>& buffer) const {
  const LoadedPoints part(points_, first - points_.first, count);
  const std::size_t step = 3 * size_of(points_.scalar);
  if (buffer.size() < count * step) buffer.resize(count * step);
  FilterScratch scratch;
  filter_->judge(part.view(), scratch);
  if (points_.scalar == ScalarType::float64) {
    copy_kept<double>(part.view(), scratch.verdicts, buffer.data());
  } else {
    copy_kept<float>(part.view(), scratch.verdicts, buffer.data());
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
