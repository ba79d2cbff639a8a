// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "prism/planar_grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl_bv::detail {
namespace {

bool comes_before(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
}

}  // namespace

// About four points a cell if they are spread evenly. Points of walls are not: their cells have some more.
PlanarGrid::PlanarGrid(const std::vector<Eigen::Vector2d>& points) : low_(points.front()) {
  Eigen::Vector2d high = low_;
  for (const Eigen::Vector2d& p : points) {
    low_ = low_.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  rounding_ = 0x1p-48 * std::max(low_.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
  const Eigen::Vector2d extent = high - low_;
  const double max_cells = std::clamp(static_cast<double>(points.size()) / 4, 1.0, 65'536.0);
  const double ratio = extent.y() > 0 ? std::sqrt(max_cells) * std::sqrt(extent.x() / extent.y()) : max_cells;
  const double columns = std::clamp(std::floor(ratio), 1.0, max_cells);
  counts_[0] = static_cast<std::size_t>(columns);
  counts_[1] = static_cast<std::size_t>(std::clamp(std::floor(max_cells / columns), 1.0, max_cells));
  for (int k = 0; k < 2; ++k)
    size_[k] = extent[k] / static_cast<double>(counts_[k]);
  std::vector<std::uint32_t> cells, next(counts_[0] * counts_[1] + 1, 0);
  cells.reserve(points.size());
  for (const Eigen::Vector2d& p : points) {
    cells.push_back(static_cast<std::uint32_t>(cell(p.y(), 1) * counts_[0] + cell(p.x(), 0)));
    ++next[cells.back() + 1];
  }
  for (std::size_t i = 1; i < next.size(); ++i)
    next[i] += next[i - 1];
  first_ = next;
  points_.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    points_[next[cells[i]]++] = points[i];
  std::size_t end = 0;
  for (std::size_t i = 0; i + 1 < first_.size(); ++i) {
    const auto begin = points_.begin() + first_[i], old_end = points_.begin() + first_[i + 1];
    std::sort(begin, old_end, comes_before);
    const auto different = std::unique(begin, old_end);
    first_[i] = static_cast<std::uint32_t>(end);
    end = static_cast<std::size_t>(std::move(begin, different, points_.begin() + static_cast<long>(end)) -
                                   points_.begin());
  }
  first_.back() = static_cast<std::uint32_t>(end);
  points_.resize(end);
}

std::size_t PlanarGrid::cell(double coordinate, int axis) const {
  const double number = (coordinate - low_[axis]) / size_[axis];
  if (!(number > 0)) return 0;  // also for a size of 0
  return std::min(static_cast<std::size_t>(std::min(number, 1e9)), counts_[axis] - 1);
}

std::uint32_t PlanarGrid::find(const Eigen::Vector2d& point) const {
  const std::size_t i = cell(point.y(), 1) * counts_[0] + cell(point.x(), 0);
  const auto found =
      std::lower_bound(points_.begin() + first_[i], points_.begin() + first_[i + 1], point, comes_before);
  return static_cast<std::uint32_t>(found - points_.begin());
}

}  // namespace pcl_bv::detail
