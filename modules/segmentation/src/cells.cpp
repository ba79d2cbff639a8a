// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cells.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace pcl_bv::detail {
namespace {

template <typename T, typename Key>
void find_runs(const std::vector<Point<T>>& points, const CellGrid& grid, BlockKeys<Key>& keys,
               CellPart<Key>& part) {
  part.runs.clear();
  // No block with points has the key 0, because each axis has a spare block below the blocks with points.
  Key last = 0;
  std::uint64_t occupied = 0;  // local, because a register is faster than memory
  for (std::size_t i = part.begin; i < part.end; ++i) {
    const CellKey<Key> key = grid.template key_of<Key>(points[i]);
    keys.bit_of_point[i] = key.bit;
    if (key.block != last) {
      if (!part.runs.empty()) part.runs.back().occupied = occupied;
      occupied = 0;
      last = key.block;
      part.runs.push_back({last, 0, static_cast<std::uint32_t>(i), 0});
    }
    occupied |= std::uint64_t{1} << key.bit;
  }
  if (!part.runs.empty()) part.runs.back().occupied = occupied;
}

// Numbers the blocks in the order in which they first occur.
template <typename Key>
void number_blocks(std::size_t points, BlockKeys<Key>& keys) {
  keys.occupied.clear();
  keys.order.clear();
  keys.index.reset(points);
  for (CellPart<Key>& part : keys.parts) {
    for (BlockRun<Key>& run : part.runs) {
      run.block = keys.index.number(run.key);
      if (run.block == keys.occupied.size()) {
        keys.occupied.push_back(0);
        keys.order.push_back({run.key, run.block});
      }
      keys.occupied[run.block] |= run.occupied;
    }
  }
}

// Sorts the blocks by key and numbers their cells. Returns the number of cells.
template <typename T, typename Key>
std::uint32_t sort_blocks(const CellGrid& grid, Cells<T>& cells, BlockKeys<Key>& keys) {
  radix_sort(keys.order, keys.spare, grid.key_bits);
  const std::size_t blocks = keys.order.size();
  cells.blocks.resize(blocks);
  keys.keys.resize(blocks);
  keys.rank.resize(blocks);
  std::uint32_t cell = 0;
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::uint32_t number = keys.order[b].point;
    keys.keys[b] = keys.order[b].key;
    keys.rank[number] = static_cast<std::uint32_t>(b);
    cells.blocks[b] = {keys.occupied[number], cell, false};
    cell += count_bits(keys.occupied[number]);
  }
  return cell;
}

// Finds the cell of each point, and counts the points of a part in each cell.
template <typename T, typename Key>
void count_cells(const BlockKeys<Key>& keys, std::uint32_t count, Cells<T>& cells, CellPart<Key>& part) {
  part.next.assign(count, 0);
  for (std::size_t r = 0; r < part.runs.size(); ++r) {
    const Block& block = cells.blocks[keys.rank[part.runs[r].block]];
    const std::size_t end = r + 1 < part.runs.size() ? part.runs[r + 1].begin : part.end;
    for (std::size_t i = part.runs[r].begin; i < end; ++i) {
      const std::uint32_t cell = block.cell(keys.bit_of_point[i]);
      cells.node[i] = cell;
      ++part.next[cell];
    }
  }
}

}  // namespace

std::int64_t cell_number(double coordinate, double inverse_side) {
  constexpr double far_cells = 0x1p53;
  const double cells = coordinate * inverse_side;
  if (std::abs(cells) < far_cells) {
    const double floor = std::floor(cells);
    const bool rounded_up = floor == cells && std::fma(coordinate, inverse_side, -cells) < 0;
    return static_cast<std::int64_t>(floor) - (rounded_up ? 1 : 0);
  }
  // The bits of a positive double, read as an integer, count the doubles from 0 to it.
  const auto bits = [](double v) { return std::bit_cast<std::int64_t>(v); };
  double first = far_cells / inverse_side;  // with its rounding: the smallest coordinate that is far
  while (first * inverse_side < far_cells)
    first = std::bit_cast<double>(bits(first) + 1);
  while (std::bit_cast<double>(bits(first) - 1) * inverse_side >= far_cells)
    first = std::bit_cast<double>(bits(first) - 1);
  const std::int64_t magnitude =
      static_cast<std::int64_t>(far_cells) + bits(std::abs(coordinate)) - bits(first);
  return cells < 0 ? -magnitude - 1 : magnitude;  // floor() of a negative number may be -far_cells
}

void CellGrid::add_axis(std::size_t axis, std::int64_t low, std::int64_t high) {
  constexpr std::int64_t spare = 4;  // in cells: one block
  origin[axis] = low - spare;
  shift[axis] = key_bits;
  const std::int64_t last_block = (high + spare - origin[axis]) / 4;
  key_bits += static_cast<unsigned>(std::bit_width(static_cast<std::uint64_t>(last_block)));
}

// `numbers` are those of the blocks of all points.
void CellGrid::add_far_axis(std::size_t axis, std::vector<std::int64_t>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  std::vector<FarBlock>& blocks = far_blocks_[axis];
  blocks.reserve(numbers.size());
  std::int64_t in_key = 1;  // after the spare block
  for (const std::int64_t number : numbers) {
    if (!blocks.empty()) in_key += number == blocks.back().number + 1 ? 1 : 2;
    blocks.push_back({number, in_key});
  }
  shift[axis] = key_bits;
  key_bits += static_cast<unsigned>(std::bit_width(static_cast<std::uint64_t>(in_key + 1)));
}

std::int64_t CellGrid::far_cell(std::size_t axis, double coordinate) const {
  const std::int64_t cell = cell_number(coordinate, inverse_side);
  const auto at =
      std::lower_bound(far_blocks_[axis].begin(), far_blocks_[axis].end(), cell >> 2,
                       [](const FarBlock& block, std::int64_t number) { return block.number < number; });
  return at->in_key << 2 | (cell & 3);
}

template <typename T>
CellGrid::CellGrid(const std::vector<Point<T>>& points, const Box<T>& box, double inverse_of_side)
    : inverse_side(inverse_of_side), origin{}, shift{}, key_bits(0), near(true) {
  constexpr std::array<T Point<T>::*, 3> axes{&Point<T>::x, &Point<T>::y, &Point<T>::z};
  const auto cell = [&](const Point<T>& p, std::size_t axis) {
    return cell_number(p.*axes[axis], inverse_side);
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t farthest = std::max(std::abs(cell(box.min, axis)), std::abs(cell(box.max, axis)));
    near = near && static_cast<double>(farthest) < near_cells;
  }
  std::vector<std::int64_t> numbers;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (near) {
      add_axis(axis, cell(box.min, axis), cell(box.max, axis));
      continue;
    }
    numbers.clear();
    for (const Point<T>& p : points)
      numbers.push_back(cell(p, axis) >> 2);
    add_far_axis(axis, numbers);
  }
}

template <typename T, typename Key>
void make_cells(const std::vector<Point<T>>& points, const CellGrid& grid, const ParallelPolicy& policy,
                Cells<T>& cells, BlockKeys<Key>& keys) {
  keys.bit_of_point.resize(points.size());
  keys.parts.cut(points.size(), policy);
  keys.parts.for_each(policy, [&](CellPart<Key>& part) { find_runs(points, grid, keys, part); });
  number_blocks(points.size(), keys);
  const std::uint32_t count = sort_blocks(grid, cells, keys);

  cells.points.resize(points.size());
  cells.node.resize(points.size());
  keys.parts.for_each(policy, [&](CellPart<Key>& part) { count_cells(keys, count, cells, part); });
  cells.begin.resize(count + 1);
  std::uint32_t end = 0;
  for (std::uint32_t c = 0; c < count; ++c) {
    cells.begin[c] = end;
    for (CellPart<Key>& part : keys.parts)
      end += std::exchange(part.next[c], end);
  }
  cells.begin[count] = end;
  keys.parts.for_each(policy, [&](CellPart<Key>& part) {
    for (std::size_t i = part.begin; i < part.end; ++i) {
      const std::uint32_t position = part.next[cells.node[i]]++;
      cells.points[position] = points[i];
      if (cells.by_point) cells.node[i] = position;
    }
  });
}

template CellGrid::CellGrid(const std::vector<Point<float>>&, const Box<float>&, double);
template CellGrid::CellGrid(const std::vector<Point<double>>&, const Box<double>&, double);
// NOLINTBEGIN(bugprone-macro-parentheses): the arguments are types
#define PCL_BV_CELLS(T, Key)                                                                                \
  template void make_cells(const std::vector<Point<T>>&, const CellGrid&, const ParallelPolicy&, Cells<T>&, \
                           BlockKeys<Key>&);
// NOLINTEND(bugprone-macro-parentheses)
PCL_BV_CELLS(float, std::uint64_t)
PCL_BV_CELLS(float, WideKey)
PCL_BV_CELLS(double, std::uint64_t)
PCL_BV_CELLS(double, WideKey)
#undef PCL_BV_CELLS

}  // namespace pcl_bv::detail
