// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "plan_basins.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace pcl_bv::detail {
namespace {

constexpr std::uint32_t kNone = static_cast<std::uint32_t>(-1);
constexpr double kMaxCells = 0x1p22;
constexpr std::size_t kReach = 2;  // number of cells to each side that add to a density

// Weights of the cells around a cell in its density.
constexpr std::array<std::array<std::uint64_t, 5>, 5> kWeights{
    {{1, 2, 3, 2, 1}, {2, 4, 5, 4, 2}, {3, 5, 6, 5, 3}, {2, 4, 5, 4, 2}, {1, 2, 3, 2, 1}}};

}  // namespace

void PlanBasins::reserve(std::size_t points, const Eigen::Vector2d& sides, double side) {
  make_grid(sides, side);
  cells_.reserve(points);
  cell_of_.reserve(points);
  order_.reserve(points);
  number_.reserve(points);
}

// Returns whether the grid is small enough. It has a margin of kReach cells on each side, so that all
// neighbours of a cell have a place.
bool PlanBasins::make_grid(const Eigen::Vector2d& sides, double side) {
  const Eigen::Vector2d cells = sides / side;
  if (!(cells.maxCoeff() < kMaxCells) || !((cells.x() + 1) * (cells.y() + 1) <= kMaxCells)) return false;
  const auto columns = static_cast<std::size_t>(cells.x()) + 1 + 2 * kReach;
  stride_ = static_cast<std::size_t>(cells.y()) + 1 + 2 * kReach;
  if (grid_.size() < columns * stride_) grid_.resize(columns * stride_, kNone);
  return true;
}

void PlanBasins::fill_cells(const std::vector<Eigen::Vector2d>& points, double side) {
  cells_.clear();
  cell_of_.clear();
  for (const Eigen::Vector2d& point : points) {
    const Eigen::Vector2d at = (point - low_) / side;
    const std::size_t place =
        (static_cast<std::size_t>(at.x()) + kReach) * stride_ + static_cast<std::size_t>(at.y()) + kReach;
    if (grid_[place] == kNone) {
      grid_[place] = static_cast<std::uint32_t>(cells_.size());
      cells_.push_back({static_cast<std::uint32_t>(place)});
    }
    ++cells_[grid_[place]].count;
    cell_of_.push_back(grid_[place]);
  }
}

// Calls visit(number, weight) for each cell that is at most kReach cells away, the cell itself included.
template <typename Visit>
void PlanBasins::visit_neighbours(std::uint32_t cell, const Visit& visit) const {
  const std::size_t place = cells_[cell].place - kReach * stride_ - kReach;
  for (std::size_t i = 0; i <= 2 * kReach; ++i) {
    for (std::size_t j = 0; j <= 2 * kReach; ++j) {
      const std::uint32_t other = grid_[place + i * stride_ + j];
      if (other != kNone) visit(other, kWeights[i][j]);
    }
  }
}

// Cells of equal density are sorted by their place, so the result does not depend on the order of the points.
void PlanBasins::sort_by_density() {
  for (std::uint32_t c = 0; c < cells_.size(); ++c) {
    visit_neighbours(c, [&](std::uint32_t other, std::uint64_t weight) {
      cells_[c].density += weight * cells_[other].count;
    });
  }
  order_.resize(cells_.size());
  std::iota(order_.begin(), order_.end(), 0U);
  std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
    const Cell &first = cells_[a], &second = cells_[b];
    return first.density != second.density ? first.density > second.density : first.place < second.place;
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
  basin_of.assign(points.size(), 0);
  if (points.empty()) return 0;
  Eigen::Vector2d high = low_ = points.front();
  for (const Eigen::Vector2d& point : points) {
    low_ = low_.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  if (!make_grid(high - low_, side)) return 1;
  fill_cells(points, side);
  sort_by_density();
  for (const std::uint32_t c : order_) {
    std::uint32_t densest = c;
    visit_neighbours(c, [&](std::uint32_t other, std::uint64_t /*weight*/) {
      if (cells_[other].rank < cells_[densest].rank) densest = other;
    });
    cells_[c].parent = densest == c ? c : peak_of(densest);
    visit_neighbours(c, [&](std::uint32_t other, std::uint64_t /*weight*/) {
      if (cells_[other].rank < cells_[c].rank) join(peak_of(c), peak_of(other), cells_[c].density);
    });
  }
  number_.assign(cells_.size(), 0);
  std::uint32_t basins = 0;
  for (const std::uint32_t c : order_)
    if (peak_of(c) == c) number_[c] = basins++;
  for (std::size_t i = 0; i < points.size(); ++i)
    basin_of[i] = number_[peak_of(cell_of_[i])];
  for (const Cell& cell : cells_)
    grid_[cell.place] = kNone;
  return basins;
}

}  // namespace pcl_bv::detail
