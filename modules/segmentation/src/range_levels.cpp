// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "range_levels.h"

#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace pcl_bv::detail {

RangeLevel range_level(float tolerance, float per_metre, std::size_t level) {
  // Uses a table instead of exp2(), whose results differ between libraries.
  constexpr std::array<double, 4> quarters{1, 1.189207115002721, 1.4142135623730951, 1.681792830507429};
  const double level_tolerance =
      std::ldexp(double{tolerance} * quarters[level % 4], static_cast<int>(level / 4));
  const double range = (level_tolerance - double{tolerance}) / double{per_metre};
  return {level_tolerance, range * range};
}

template <typename T>
void RangeLevels<T>::start(const std::vector<Point<T>>& points) {
  points_ = points;
  position_.resize(points.size());
  std::iota(position_.begin(), position_.end(), 0U);
  sets_.reset(points.size());
}

template <typename T>
bool RangeLevels<T>::advance_to(const RangeLevel& level, const Eigen::Vector3d& origin) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Point<T> p = points_[i];
    if (squared_norm(p.x - origin.x(), p.y - origin.y(), p.z - origin.z()) < level.min_squared_range)
      continue;
    points_[count] = p;
    position_[count++] = position_[i];
  }
  points_.resize(count);
  position_.resize(count);
  return count > 0;
}

template <typename T>
void RangeLevels<T>::unite(const std::vector<std::uint32_t>& roots, const std::vector<std::uint32_t>& node) {
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  first_of_root_.assign(roots.size(), none);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    std::uint32_t& first = first_of_root_[roots[node[i]]];
    if (first == none) {
      first = position_[i];
    } else {
      sets_.unite(first, position_[i]);
    }
  }
}

template class RangeLevels<float>;
template class RangeLevels<double>;

}  // namespace pcl_bv::detail
