// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "plan_basins.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

namespace pcl_bv::detail {
namespace {

constexpr std::int64_t kReach = 2;  // number of cells to each side that add to a density

// Weight of a cell in the density of another cell, by the squared distance of both.
constexpr std::array<std::uint64_t, 9> kWeights{6, 5, 4, 0, 3, 2, 0, 0, 1};

}  // namespace

void PlanBasins::reserve(std::size_t points) {
  placed_.reserve(points);
  cells_.reserve(points);
  cell_of_.reserve(points);
  order_.reserve(points);
  number_.reserve(points);
}

void PlanBasins::fill_cells(const std::vector<Eigen::Vector2d>& points, double side) {
  placed_.clear();
  for (const Eigen::Vector2d& point : points) {
    placed_.push_back({static_cast<std::int64_t>(std::floor(point.x() / side)),
                       static_cast<std::int64_t>(std::floor(point.y() / side)),
                       static_cast<std::uint32_t>(placed_.size())});
  }
  std::sort(placed_.begin(), placed_.end(), [](const PlacedPoint& a, const PlacedPoint& b) {
    return std::tie(a.x, a.y) < std::tie(b.x, b.y);
  });
  cells_.clear();
  cell_of_.resize(points.size());
  for (const PlacedPoint& at : placed_) {
    if (cells_.empty() || cells_.back().x != at.x || cells_.back().y != at.y) {
      cells_.push_back({at.x, at.y});
      cells_.back().parent = static_cast<std::uint32_t>(cells_.size() - 1);
    }
    ++cells_.back().count;
    cell_of_[at.point] = static_cast<std::uint32_t>(cells_.size() - 1);
  }
}

// Calls visit(number, dx, dy) for each cell that is at most kReach cells away, the cell itself included.
template <typename Visit>
void PlanBasins::visit_neighbours(std::uint32_t cell, const Visit& visit) const {
  const std::int64_t x = cells_[cell].x, y = cells_[cell].y;
  for (std::int64_t dx = -kReach; dx <= kReach; ++dx) {
    auto at = std::lower_bound(cells_.begin(), cells_.end(), std::pair(x + dx, y - kReach),
                               [](const Cell& c, const auto& place) {
                                 return std::tie(c.x, c.y) < std::tie(place.first, place.second);
                               });
    for (; at != cells_.end() && at->x == x + dx && at->y <= y + kReach; ++at)
      visit(static_cast<std::uint32_t>(at - cells_.begin()), dx, at->y - y);
  }
}

void PlanBasins::sort_by_density() {
  for (std::uint32_t c = 0; c < cells_.size(); ++c) {
    visit_neighbours(c, [&](std::uint32_t other, std::int64_t dx, std::int64_t dy) {
      cells_[c].density += kWeights[static_cast<std::size_t>(dx * dx + dy * dy)] * cells_[other].count;
    });
  }
  order_.resize(cells_.size());
  std::iota(order_.begin(), order_.end(), 0U);
  std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
    return cells_[a].density != cells_[b].density ? cells_[a].density > cells_[b].density : a < b;
  });
  for (std::uint32_t rank = 0; rank < order_.size(); ++rank)
    cells_[order_[rank]].rank = rank;
}

std::uint32_t PlanBasins::peak_of(std::uint32_t cell) {
  while (cells_[cell].parent != cell)
    cell = cells_[cell].parent = cells_[cells_[cell].parent].parent;
  return cell;
}

void PlanBasins::join(std::uint32_t a, std::uint32_t b, std::uint64_t saddle) {
  const std::uint32_t low = cells_[a].rank > cells_[b].rank ? a : b, high = low == a ? b : a;
  if (low != high && 2 * saddle >= cells_[low].density) cells_[low].parent = high;
}

// Adds the cells in the order of descending density. Each cell joins its densest neighbour. If other
// neighbours belong to other basins, the cell is the saddle between these basins.
std::size_t PlanBasins::find(const std::vector<Eigen::Vector2d>& points, double side,
                             std::vector<std::uint32_t>& basin_of) {
  fill_cells(points, side);
  sort_by_density();
  for (const std::uint32_t c : order_) {
    std::uint32_t densest = c;
    visit_neighbours(c, [&](std::uint32_t other, std::int64_t /*dx*/, std::int64_t /*dy*/) {
      if (cells_[other].rank < cells_[densest].rank) densest = other;
    });
    cells_[c].parent = densest == c ? c : peak_of(densest);
    visit_neighbours(c, [&](std::uint32_t other, std::int64_t /*dx*/, std::int64_t /*dy*/) {
      if (cells_[other].rank < cells_[c].rank) join(peak_of(c), peak_of(other), cells_[c].density);
    });
  }
  number_.assign(cells_.size(), 0);
  std::uint32_t basins = 0;
  for (const std::uint32_t c : order_)
    if (peak_of(c) == c) number_[c] = basins++;
  basin_of.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    basin_of[i] = number_[peak_of(cell_of_[i])];
  return basins;
}

}  // namespace pcl_bv::detail
