// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "bricks.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace pcl_bv::detail {
namespace {

constexpr unsigned kAxisBits = 21;
constexpr double kMaxCells = 1U << kAxisBits;  // along an axis

struct CountedCell {
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

Bricks::Bricks(const Coordinates& anchor, double halo) : anchor_(anchor) {
  side_ = 16 * halo;
  per_side_ = 1 / side_;
  // The second term covers the rounding of relative(), below 2^-30 for numbers up to 2^21.
  margin_ = halo / side_ * (1 + 1e-9) + 0x1p-29;
}

// Returns coordinates in units of cells, which are from 0 on.
Coordinates Bricks::relative(const Coordinates& point) const {
  constexpr double middle = kMaxCells / 2;
  return {(point.x - anchor_.x) * per_side_ + middle, (point.y - anchor_.y) * per_side_ + middle,
          (point.z - anchor_.z) * per_side_ + middle};
}

Bricks::Position Bricks::position(const Coordinates& point) const {
  const Coordinates at = relative(point);
  const auto number = [](double x) { return static_cast<std::uint32_t>(std::clamp(x, 0.0, kMaxCells - 1)); };
  return {number(at.x), number(at.y), number(at.z)};
}

std::uint64_t Bricks::key(const Position& position) {
  return (std::uint64_t{position[0]} << (2 * kAxisBits)) | (std::uint64_t{position[1]} << kAxisBits) |
         position[2];
}

Bricks::Position Bricks::position_of(std::uint64_t key) {
  constexpr std::uint64_t mask = (std::uint64_t{1} << kAxisBits) - 1;
  return {static_cast<std::uint32_t>(key >> (2 * kAxisBits)),
          static_cast<std::uint32_t>(key >> kAxisBits & mask), static_cast<std::uint32_t>(key & mask)};
}

const Bricks::Cell* Bricks::neighbour(const Position& position, int dx, int dy, int dz) const {
  const std::int64_t x = std::int64_t{position[0]} + dx, y = std::int64_t{position[1]} + dy,
                     z = std::int64_t{position[2]} + dz;
  if (std::min({x, y, z}) < 0 || std::max({x, y, z}) >= static_cast<std::int64_t>(kMaxCells)) return nullptr;
  const auto found = cells_.find(
      key({static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(z)}));
  return found == cells_.end() ? nullptr : &found->second;
}

void Bricks::divide(std::size_t max_points) {
  std::vector<CountedCell> cells;
  cells.reserve(cells_.size());
  for (const auto& [key, cell] : cells_)
    cells.push_back({position_of(key), cell.points});
  size_ = 0;
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
      cells_.at(key(it->position)).brick = static_cast<std::uint32_t>(size_);
    ++size_;
  }
  for (auto& [key, cell] : cells_) {
    const Position position = position_of(key);
    cell.inner = true;
    for (int i = 0; i < 27; ++i) {
      const Cell* const other = neighbour(position, i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      if (other != nullptr && other->brick != cell.brick) cell.inner = false;
    }
  }
}

const Bricks::Cell& Bricks::cell_of(std::uint64_t key) const {
  const auto found = cells_.find(key);
  if (found == cells_.end()) throw std::runtime_error("the points have changed while they were read");
  return found->second;
}

Bricks::Place Bricks::place(const Coordinates& point, Cursor& cursor) const {
  const Position at = position(point);
  if (const std::uint64_t key = Bricks::key(at); key != cursor.key) cursor = {key, &cell_of(key)};
  const Cell& own = *cursor.cell;
  Place place;
  place.own = own.brick;
  if (own.inner) return place;
  const Coordinates relative = this->relative(point);
  std::array<std::array<bool, 3>, 3>
      near;  // for each axis: whether cells before, at and after the point's are near
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double part = relative[axis] - at[axis];
    near[axis] = {part <= margin_, true, part >= 1 - margin_};
  }
  for (int i = 0; i < 27; ++i) {
    const int x = i % 3, y = i / 3 % 3, z = i / 9;
    if (!near[0][static_cast<std::size_t>(x)] || !near[1][static_cast<std::size_t>(y)] ||
        !near[2][static_cast<std::size_t>(z)])
      continue;
    const Cell* const other = neighbour(at, x - 1, y - 1, z - 1);
    if (other == nullptr || other->brick == own.brick) continue;
    const auto end = place.other.begin() + place.others;
    if (std::find(place.other.begin(), end, other->brick) == end) place.other[place.others++] = other->brick;
  }
  return place;
}

}  // namespace pcl_bv::detail
