// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pcl_bv/points/point_view.h"

namespace pcl_bv::detail {

/// Returns what PointView::subset() returns, without checks of the indices. O(1).
inline PointView select_points(PointView points, const std::int32_t* indices, std::size_t count) {
  // For records without an index list, PointView::data is the address of point number `first`. With an index
  // list, it must be the address of point number 0.
  const bool slice =
      points.indices == nullptr && points.order == PointOrder::records && points.data != nullptr;
  if (slice) points.data -= points.stride * points.first;
  points.first = 0;
  points.indices = indices;
  points.count = count;
  return points;
}

inline PointView select_points(const PointView& points, const std::vector<std::int32_t>& indices) {
  return select_points(points, indices.data(), indices.size());
}

}  // namespace pcl_bv::detail
