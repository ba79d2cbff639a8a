// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include "pcl_bv/kernels/point_view.h"

namespace pcl_bv {

/// Points of a cloud in memory by their numbers, which are known to be right.
inline PointView subset(PointView cloud, const std::int32_t* numbers, std::size_t count) {
  // A slice counts from its cloud's first point, but begins elsewhere.
  const bool moved = cloud.indices == nullptr && cloud.order == PointOrder::records && cloud.data != nullptr;
  if (moved) cloud.data -= cloud.stride * cloud.first;
  cloud.first = 0;
  cloud.indices = numbers;
  cloud.count = count;
  return cloud;
}

inline PointView subset(const PointView& cloud, const std::vector<std::int32_t>& numbers) {
  return subset(cloud, numbers.data(), numbers.size());
}

}  // namespace pcl_bv
