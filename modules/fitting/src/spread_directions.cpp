// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "spread_directions.h"

#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv::detail {

std::vector<Direction> spread_directions() {
  std::vector<Direction> directions;
  for (int a = 0; a <= 2; ++a) {
    for (int b = -2; b <= 2; ++b) {
      for (int c = -2; c <= 2; ++c) {
        const bool upper = a > 0 || b > 0 || (b == 0 && c > 0);
        const bool reduced = a % 2 != 0 || b % 2 != 0 || c % 2 != 0;
        if (upper && reduced)
          directions.push_back({static_cast<double>(a), static_cast<double>(b), static_cast<double>(c)});
      }
    }
  }
  return directions;
}

std::vector<Eigen::Vector3d> support_points_along(const std::vector<Eigen::Vector3d>& directions,
                                                  const std::vector<Eigen::Vector3d>& points) {
  std::vector<bool> is_support(points.size());
  for (const Eigen::Vector3d& n : directions) {
    std::size_t low = 0, high = 0;
    for (std::size_t i = 1; i < points.size(); ++i) {
      if (dot3(n, points[i]) < dot3(n, points[low])) low = i;
      if (dot3(n, points[i]) > dot3(n, points[high])) high = i;
    }
    is_support[low] = is_support[high] = true;
  }
  std::vector<Eigen::Vector3d> found;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_support[i]) found.push_back(points[i]);
  }
  return found;
}

}  // namespace pcl_bv::detail
