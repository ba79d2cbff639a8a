// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cells.h"

#include <algorithm>
#include <bit>

namespace pcl_bv {
namespace {

// Which block and which of its cells each point is in; blocks are numbered as they are met.
template <typename T, typename Key>
void place_points(const std::vector<Point<T>>& points, const CellGrid& grid, BlockKeys<Key>& keys) {
  const std::size_t n = points.size();
  keys.block_of_point.resize(n);
  keys.bit_of_point.resize(n);
  keys.occupied.clear();
  keys.order.clear();
  keys.index.reset(n);
  Key last = 0;  // Of no block that holds points: all of those have a spare block below them.
  std::uint32_t block = 0;
  std::uint64_t occupied = 0;  // By points of this block in a row: in a register, faster than in memory.
  for (std::size_t i = 0; i < n; ++i) {
    const CellPlace<Key> place = grid.template place<Key>(points[i]);
    if (place.block != last) {
      if (i > 0) keys.occupied[block] |= occupied;
      occupied = 0;
      last = place.block;
      block = keys.index.number(last);
      if (block == keys.occupied.size()) {
        keys.occupied.push_back(0);
        keys.order.push_back({last, block});
      }
    }
    keys.block_of_point[i] = block;
    keys.bit_of_point[i] = place.bit;
    occupied |= std::uint64_t{1} << place.bit;
  }
  keys.occupied[block] |= occupied;
}

// Puts the blocks in the order of their keys and numbers their cells. Returns how many cells there are.
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

}  // namespace

std::int64_t far_cell_number(double cells) {
  // The bits of a positive double grow with it, 2^52 to an octave; 2^28 remain, the step being 2^12 cells at
  // least.
  const auto steps = [](double v) { return std::bit_cast<std::int64_t>(v) >> 24; };
  const std::int64_t magnitude =
      static_cast<std::int64_t>(far_cells) + steps(std::abs(cells)) - steps(far_cells);
  return cells < 0 ? -magnitude : magnitude;
}

void CellGrid::add_axis(std::size_t axis, double min, double max) {
  constexpr std::int64_t spare = 4;  // A block's worth of cells.
  const std::int64_t low = cell_number(min, inverse_side);
  const std::int64_t high = cell_number(max, inverse_side);
  origin[axis] = low - spare;
  shift[axis] = key_bits;
  const std::int64_t last_block = (high + spare - origin[axis]) / 4;
  key_bits += static_cast<unsigned>(std::bit_width(static_cast<std::uint64_t>(last_block)));
  near = near && static_cast<double>(std::max(std::abs(low), std::abs(high))) < near_cells;
}

template <typename T, typename Key>
void make_cells(const std::vector<Point<T>>& points, const CellGrid& grid, Cells<T>& cells,
                BlockKeys<Key>& keys) {
  place_points(points, grid, keys);
  const std::uint32_t count = sort_blocks(grid, cells, keys);

  const std::size_t n = points.size();
  cells.points.resize(n);
  cells.node.resize(n);
  // Cell c is counted at c + 2, so that c + 1 is where its next point goes.
  cells.begin.assign(count + 2, 0);
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t cell = cells.blocks[keys.rank[keys.block_of_point[i]]].cell(keys.bit_of_point[i]);
    cells.node[i] = cell;
    ++cells.begin[cell + 2];
  }
  for (std::uint32_t c = 0; c < count; ++c)
    cells.begin[c + 2] += cells.begin[c + 1];
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t place = cells.begin[cells.node[i] + 1]++;
    cells.points[place] = points[i];
    if (cells.by_point) cells.node[i] = place;
  }
  cells.begin.pop_back();
}

// NOLINTBEGIN(bugprone-macro-parentheses): the arguments are types
#define PCL_BV_CELLS(T, Key) \
  template void make_cells(const std::vector<Point<T>>&, const CellGrid&, Cells<T>&, BlockKeys<Key>&);
// NOLINTEND(bugprone-macro-parentheses)
PCL_BV_CELLS(float, std::uint64_t)
PCL_BV_CELLS(float, WideKey)
PCL_BV_CELLS(double, std::uint64_t)
PCL_BV_CELLS(double, WideKey)
#undef PCL_BV_CELLS

}  // namespace pcl_bv
