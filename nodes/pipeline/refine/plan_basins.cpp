// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "plan_basins.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl_bv::detail {
namespace {

constexpr std::uint32_t kNone = static_cast<std::uint32_t>(-1);
constexpr double kMaxCells = 0x1p22;
constexpr std::size_t kReach = 2;  // number of cells to each side that add to a density
constexpr std::size_t kWidth = 2 * kReach + 1;

// Weights of the cells around a cell in its density.
constexpr std::array<std::array<std::uint64_t, 5>, 5> kWeights{
    {{1, 2, 3, 2, 1}, {2, 4, 5, 4, 2}, {3, 5, 6, 5, 3}, {2, 4, 5, 4, 2}, {1, 2, 3, 2, 1}}};

}  // namespace

void PlanBasins::reserve(std::size_t points, const Eigen::Vector2d& sides, double side) {
  make_grid(sides, side);
  cells_.reserve(points);
  parent_.reserve(points);
  place_of_.reserve(points);
  basin_.reserve(points);
}

// Returns whether the grid is small enough. It has a margin of kReach cells on each side, so that all
// neighbours of a cell have a place.
bool PlanBasins::make_grid(const Eigen::Vector2d& sides, double side) {
  const Eigen::Vector2d cells = sides / side;
  if (!(cells.maxCoeff() < kMaxCells) || !((cells.x() + 1) * (cells.y() + 1) <= kMaxCells)) return false;
  const auto columns = static_cast<std::size_t>(cells.x()) + 1 + 2 * kReach;
  stride_ = static_cast<std::size_t>(cells.y()) + 1 + 2 * kReach;
  if (count_.size() < columns * stride_) {
    count_.resize(columns * stride_, 0);
    number_.resize(columns * stride_, kNone);
  }
  return true;
}

void PlanBasins::fill_cells(const std::vector<Eigen::Vector2d>& points, double side) {
  cells_.clear();
  place_of_.clear();
  for (const Eigen::Vector2d& point : points) {
    const Eigen::Vector2d at = (point - low_) / side;
    const std::size_t place =
        (static_cast<std::size_t>(at.x()) + kReach) * stride_ + static_cast<std::size_t>(at.y()) + kReach;
    if (count_[place]++ == 0) cells_.push_back({0, static_cast<std::uint32_t>(place)});
    place_of_.push_back(static_cast<std::uint32_t>(place));
  }
}

void PlanBasins::sort_by_density() {
  for (Cell& cell : cells_) {
    const std::uint32_t* column = &count_[cell.place - kReach * stride_ - kReach];
    for (const auto& weights : kWeights) {
      for (std::size_t j = 0; j < weights.size(); ++j)
        cell.density += weights[j] * column[j];
      column += stride_;
    }
  }
  std::sort(cells_.begin(), cells_.end());
  for (std::uint32_t c = 0; c < cells_.size(); ++c)
    number_[cells_[c].place] = c;
}

std::uint32_t PlanBasins::peak_of(std::uint32_t cell) {
  while (parent_[cell] != cell)
    cell = parent_[cell] = parent_[parent_[cell]];
  return cell;
}

// Joins the basins of two peaks, unless the saddle is too low.
void PlanBasins::join(std::uint32_t a, std::uint32_t b, std::uint64_t saddle) {
  const auto [denser, sparser] = std::minmax(a, b);
  if (denser != sparser && 2 * saddle >= cells_[sparser].density) parent_[sparser] = denser;
}

// Adds the cells in the order of descending density. Each cell joins its densest neighbour. If other
// neighbours belong to other basins, the cell is the saddle between these basins.
void PlanBasins::join_cells() {
  parent_.resize(cells_.size());
  std::array<std::uint32_t, kWidth * kWidth> denser{};
  for (std::uint32_t c = 0; c < cells_.size(); ++c) {
    std::size_t count = 0;
    std::uint32_t densest = c;
    const std::uint32_t* column = &number_[cells_[c].place - kReach * stride_ - kReach];
    for (std::size_t i = 0; i < kWidth; ++i, column += stride_) {
      for (std::size_t j = 0; j < kWidth; ++j) {
        if (column[j] >= c) continue;
        denser[count++] = column[j];
        densest = std::min(densest, column[j]);
      }
    }
    parent_[c] = densest == c ? c : peak_of(densest);
    for (std::size_t i = 0; i < count; ++i)
      join(peak_of(c), peak_of(denser[i]), cells_[c].density);
  }
}

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
  join_cells();
  basin_.assign(cells_.size(), 0);
  std::uint32_t basins = 0;
  for (std::uint32_t c = 0; c < cells_.size(); ++c)
    basin_[c] = parent_[c] == c ? basins++ : basin_[peak_of(c)];
  for (std::size_t i = 0; i < points.size(); ++i)
    basin_of[i] = basin_[number_[place_of_[i]]];
  for (const Cell& cell : cells_) {
    count_[cell.place] = 0;
    number_[cell.place] = kNone;
  }
  return basins;
}

}  // namespace pcl_bv::detail
