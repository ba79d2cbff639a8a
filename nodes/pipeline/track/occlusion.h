// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <utility>

#include "pcl_bv/volumes/aabb.h"

namespace pcl_bv::detail {

/// Whether the box probably occludes the position: seen from above, the straight line from the
/// sensor at the origin to the position enters the box, and the box reaches the height of the position.
inline bool occludes(const Aabb& box, const Eigen::Vector3d& position) {
  if (box.max().z() < position.z()) return false;
  double enter = 0, leave = 1;  // parts of the line
  for (int i = 0; i < 2; ++i) {
    if (position[i] == 0) {
      if (box.min()[i] > 0 || box.max()[i] < 0) return false;
      continue;
    }
    const auto [first, last] = std::minmax({box.min()[i] / position[i], box.max()[i] / position[i]});
    enter = std::max(enter, first);
    leave = std::min(leave, last);
  }
  return enter > 0 && enter < leave;
}

}  // namespace pcl_bv::detail
