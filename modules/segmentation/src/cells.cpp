// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cells.h"

#include <algorithm>
#include <bit>
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

std::int64_t far_cell_number(double cells) {
  // Read as an integer, the bits of a positive double increase with the double, with 2^52 values in each
  // octave. Dropping 24 bits leaves 2^28 steps per octave. Each step is at least 2^12 cells.
  const auto steps = [](double v) { return std::bit_cast<std::int64_t>(v) >> 24; };
  const std::int64_t magnitude =
      static_cast<std::int64_t>(far_cells) + steps(std::abs(cells)) - steps(far_cells);
  return cells < 0 ? -magnitude : magnitude;
}

void CellGrid::add_axis(std::size_t axis, double min, double max) {
  constexpr std::int64_t spare = 4;  // in cells: one block
  const std::int64_t low = cell_number(min, inverse_side);
  const std::int64_t high = cell_number(max, inverse_side);
  origin[axis] = low - spare;
  shift[axis] = key_bits;
  const std::int64_t last_block = (high + spare - origin[axis]) / 4;
  key_bits += static_cast<unsigned>(std::bit_width(static_cast<std::uint64_t>(last_block)));
  near = near && static_cast<double>(std::max(std::abs(low), std::abs(high))) < near_cells;
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
