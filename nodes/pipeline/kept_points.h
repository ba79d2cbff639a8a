// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Copies points and replaces dropped ones by NaN, so that the other points keep their numbers.
#pragma once

#include <cstddef>
#include <cstring>
#include <limits>
#include <vector>

#include "pcl_bv/points/point_source.h"

namespace pcl_bv::detail {

template <typename T, typename Keeps>
void copy_kept(const PointView& points, const Keeps& keeps, std::byte* to) {
  constexpr T nan = std::numeric_limits<T>::quiet_NaN();
  constexpr T dropped[3] = {nan, nan, nan};
  for (std::size_t i = 0; i < points.count; ++i, to += sizeof dropped) {
    T p[3];
    load_point(points, i, p);
    std::memcpy(to, keeps(i) ? p : dropped, sizeof p);
  }
}

/// Copies the points to `buffer`, which is enlarged if needed. Point i is replaced by NaN unless keeps(i).
/// Returns a view of the copy, whose first point has the number `first`. The points must be in memory.
template <typename Keeps>
PointView kept_points(const PointView& points, std::size_t first, const Keeps& keeps,
                      std::vector<std::byte>& buffer) {
  const std::size_t step = 3 * size_of(points.scalar);
  if (buffer.size() < points.count * step) buffer.resize(points.count * step);
  if (points.scalar == ScalarType::float64) {
    copy_kept<double>(points, keeps, buffer.data());
  } else {
    copy_kept<float>(points, keeps, buffer.data());
  }
  return packed_points(buffer.data(), points.scalar, points.count, first);
}

}  // namespace pcl_bv::detail
