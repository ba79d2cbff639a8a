// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "pcl_bv/volumes/obb.h"

namespace pcl_bv::testing {

// All 24 ways to name the axes of a box, right-handed.
inline std::vector<Obb> all_names(const Obb& box) {
  std::vector<Obb> names;
  std::array<int, 3> order{0, 1, 2};
  do {
    for (int signs = 0; signs < 4; ++signs) {
      Eigen::Matrix3d axes;
      Eigen::Vector3d h;
      for (int i = 0; i < 3; ++i) {
        axes.col(i) = box.axis(order[static_cast<std::size_t>(i)]) * (i < 2 && (signs >> i & 1) ? -1 : 1);
        h[i] = box.half_extents()[order[static_cast<std::size_t>(i)]];
      }
      names.emplace_back(box.center(), axes, h);  // the constructor turns axis 2
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return names;
}

}  // namespace pcl_bv::testing
