// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "range_levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "components.h"
#include "pcl_bv/numeric/constants.h"

namespace pcl_bv::detail {
namespace {

double level_tolerance(float tolerance, std::size_t level) {
  // Uses a table instead of exp2(), whose results differ between libraries.
  constexpr std::array<double, 4> quarters{1, 1.189207115002721, 1.4142135623730951, 1.681792830507429};
  return std::ldexp(double{tolerance} * quarters[level % 4], static_cast<int>(level / 4));
}

}  // namespace

// Adds levels until no point is beyond the last, or the next tolerance is not a finite float.
template <typename T>
void RangeLevels<T>::add_levels(double max_squared_range, float tolerance, float per_metre) {
  levels_.clear();
  for (std::size_t i = 0;; ++i) {
    const double level = level_tolerance(tolerance, i);
    const double range = (level - double{tolerance}) / double{per_metre};
    if (range * range > max_squared_range || level > double{std::numeric_limits<float>::max()}) break;
    levels_.push_back({static_cast<float>(level), range, range * range, 0});
  }
  levels_.push_back({0, kInfinity, kInfinity, 0});
}

template <typename T>
double RangeLevels<T>::squared_range(const Point<T>& p) const {
  return squared_norm(p.x - origin_.x(), p.y - origin_.y(), p.z - origin_.z());
}

template <typename T>
std::size_t RangeLevels<T>::level_of(const Point<T>& p) const {
  const auto above =
      std::upper_bound(levels_.begin(), levels_.end(), squared_range(p),
                       [](double squared, const Level& level) { return squared < level.squared_range; });
  return static_cast<std::size_t>(above - levels_.begin()) - 1;
}

template <typename T>
void RangeLevels<T>::start(const std::vector<Point<T>>& points, const ClusterOptions& options) {
  origin_ = options.range_origin;
  double farthest = 0;
  for (const Point<T>& p : points)
    farthest = std::max(farthest, squared_range(p));
  add_levels(farthest, options.tolerance, options.tolerance_per_metre);
  // Sorts the points by counting. Level::begin is first the number of points at the previous level.
  for (const Point<T>& p : points)
    ++levels_[level_of(p) + 1].begin;
  for (std::size_t i = 1; i < levels_.size(); ++i)
    levels_[i].begin += levels_[i - 1].begin;
  sorted_.resize(points.size());
  position_.resize(points.size());
  std::vector<std::uint32_t>& to = first_of_root_;
  to.clear();
  for (const Level& level : levels_)
    to.push_back(level.begin);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::uint32_t at = to[level_of(points[i])]++;
    sorted_[at] = points[i];
    position_[at] = static_cast<std::uint32_t>(i);
  }
  sets_.reset(points.size());
  level_ = levels_.size();
}

template <typename T>
bool RangeLevels<T>::next() {
  level_ = level_ == levels_.size() ? 0 : level_ + 1;
  while (level_ + 1 < levels_.size() && levels_[level_].begin == levels_[level_ + 1].begin)
    ++level_;
  if (level_ + 1 >= levels_.size()) return false;
  const T r2 = static_cast<T>(double{tolerance()} * double{tolerance()});
  // Twice the tolerance covers denormal squares. The factor covers the rounding of ranges.
  const double max_range = (levels_[level_ + 1].range + 2 * max_linked_difference(r2)) * (1 + 1e-9);
  const auto end = std::find_if(levels_.begin() + static_cast<std::ptrdiff_t>(level_) + 1, levels_.end() - 1,
                                [&](const Level& level) { return level.range > max_range; });
  points_.assign(sorted_.begin() + levels_[level_].begin, sorted_.begin() + end->begin);
  return true;
}

template <typename T>
void RangeLevels<T>::unite(const std::vector<std::uint32_t>& roots, const std::vector<std::uint32_t>& node) {
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  const std::uint32_t* const position = position_.data() + levels_[level_].begin;
  first_of_root_.assign(roots.size(), none);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    std::uint32_t& first = first_of_root_[roots[node[i]]];
    if (first == none) {
      first = position[i];
    } else {
      sets_.unite(first, position[i]);
    }
  }
}

template class RangeLevels<float>;
template class RangeLevels<double>;

}  // namespace pcl_bv::detail
