// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "bricks.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace pcl_bv::detail {
namespace {

struct CountedCell {
  std::uint64_t key;
  std::array<std::uint32_t, 3> position;
  std::uint64_t points;
};
using CellRange = std::pair<std::vector<CountedCell>::iterator, std::vector<CountedCell>::iterator>;

std::uint64_t points_in(const CellRange& range) {
  std::uint64_t points = 0;
  for (auto it = range.first; it != range.second; ++it)
    points += it->points;
  return points;
}

std::size_t longest_axis(const CellRange& range) {
  std::array<std::uint32_t, 3> low{~0U, ~0U, ~0U}, high{};
  for (auto it = range.first; it != range.second; ++it) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], it->position[axis]);
      high[axis] = std::max(high[axis], it->position[axis]);
    }
  }
  std::size_t longest = 0;
  for (std::size_t axis = 1; axis < 3; ++axis)
    if (high[axis] - low[axis] > high[longest] - low[longest]) longest = axis;
  return longest;
}

// Cuts a range with about half of the points on each side, between two planes of cells. Returns the end of
// the range if all cells are in one plane.
std::vector<CountedCell>::iterator cut(const CellRange& range, std::uint64_t points) {
  const std::size_t axis = longest_axis(range);
  std::sort(range.first, range.second, [axis](const CountedCell& a, const CountedCell& b) {
    return a.position[axis] != b.position[axis] ? a.position[axis] < b.position[axis]
                                                : a.position < b.position;
  });
  auto best = range.second;
  std::uint64_t before = 0, best_difference = points;
  for (auto it = range.first; it != range.second; ++it) {
    if (it != range.first && it->position[axis] != std::prev(it)->position[axis]) {
      const std::uint64_t difference = before > points - before ? 2 * before - points : points - 2 * before;
      if (difference < best_difference) {
        best_difference = difference;
        best = it;
      }
    }
    before += it->points;
  }
  return best;
}

}  // namespace

const Bricks::Cell* Bricks::find(std::uint64_t key) const {
  const auto found = cells_.find(key);
  return found == cells_.end() ? nullptr : &found->second;
}

std::vector<std::uint64_t> Bricks::cells() const {
  std::vector<std::uint64_t> keys;
  keys.reserve(cells_.size());
  for (const auto& [key, cell] : cells_)
    keys.push_back(key);
  return keys;
}

bool Bricks::is_inner(std::uint64_t key, const Cell& cell) const {
  for (int i = 0; i < 27; ++i) {
    const Cell* const other = find(BrickGrid::neighbour(key, i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1));
    if (other != nullptr && other->brick != cell.brick) return false;
  }
  return true;
}

void Bricks::divide(std::size_t max_points) {
  std::vector<CountedCell> cells;
  cells.reserve(cells_.size());
  for (const auto& [key, cell] : cells_)
    cells.push_back({key, BrickGrid::position(key), cell.points});
  first_point_ = {0};
  std::vector<CellRange> ranges;
  if (!cells.empty()) ranges.emplace_back(cells.begin(), cells.end());
  while (!ranges.empty()) {
    const CellRange range = ranges.back();
    ranges.pop_back();
    const std::uint64_t points = points_in(range);
    const auto middle = points > max_points ? cut(range, points) : range.second;
    if (middle != range.second) {
      ranges.emplace_back(middle, range.second);
      ranges.emplace_back(range.first, middle);
      continue;
    }
    for (auto it = range.first; it != range.second; ++it)
      cells_.at(it->key).brick = static_cast<std::uint32_t>(size());
    first_point_.push_back(first_point_.back() + points);
  }
  for (auto& [key, cell] : cells_)
    cell.inner = is_inner(key, cell);
}

Bricks::Place Bricks::place(const Coordinates& point, Cursor& cursor) const {
  const std::array<double, 3> at = grid_.scaled(point);
  if (!cursor.at.contains(at)) {
    cursor.at = grid_.cell_of(at);
    cursor.cell = find(cursor.at.key);
  }
  Place place;
  if (cursor.cell != nullptr) {
    place.own = cursor.cell->brick;
    if (cursor.cell->inner) return place;
  }
  // For each axis: whether cells before, at and after the point's are near.
  std::array<std::array<bool, 3>, 3> near;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    near[axis] = {at[axis] - cursor.at.begin[axis] <= cursor.at.margin[axis], true,
                  cursor.at.end[axis] - at[axis] <= cursor.at.margin[axis]};
  }
  for (int i = 0; i < 27; ++i) {
    const int x = i % 3, y = i / 3 % 3, z = i / 9;
    if (!near[0][static_cast<std::size_t>(x)] || !near[1][static_cast<std::size_t>(y)] ||
        !near[2][static_cast<std::size_t>(z)])
      continue;
    const Cell* const other = find(BrickGrid::neighbour(cursor.at.key, x - 1, y - 1, z - 1));
    if (other == nullptr || other->brick == place.own) continue;
    const auto end = place.other.begin() + place.others;
    if (std::find(place.other.begin(), end, other->brick) == end) place.other[place.others++] = other->brick;
  }
  return place;
}

}  // namespace pcl_bv::detail
