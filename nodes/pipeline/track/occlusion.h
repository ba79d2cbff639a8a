// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <utility>

#include "pcl_bv/volumes/aabb.h"

namespace pcl_bv::detail {

/// Whether the box probably occludes the position: seen from above, the straight line from the
/// sensor at `from` to the position enters the box, and the box reaches the height of the position.
inline bool occludes(const Aabb& box, const Eigen::Vector3d& position,
                     const Eigen::Vector3d& from = Eigen::Vector3d::Zero()) {
  if (box.max().z() < position.z()) return false;
  double enter = 0, leave = 1;  // parts of the line
  for (int i = 0; i < 2; ++i) {
    const double low = box.min()[i] - from[i], high = box.max()[i] - from[i], ray = position[i] - from[i];
    if (ray == 0) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    const auto [first, last] = std::minmax({low / ray, high / ray});
    enter = std::max(enter, first);
    leave = std::min(leave, last);
  }
  return enter > 0 && enter < leave;
}

/// Whether at least 80 % of the area of a box, seen from above, are inside another box.
inline bool is_inside(const Aabb& box, const Aabb& other) {
  constexpr double kShare = 0.8;
  if (box.empty() || other.empty()) return false;
  const Eigen::Vector3d common = box.max().cwiseMin(other.max()) - box.min().cwiseMax(other.min());
  const Eigen::Vector3d size = box.max() - box.min();
  return common.x() >= 0 && common.y() >= 0 && common.x() * common.y() >= kShare * size.x() * size.y();
}

}  // namespace pcl_bv::detail
