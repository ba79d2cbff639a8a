// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Cells by sorting, and their neighbours by sweeping the sorted keys: no hash table.
#include "cells.h"

#include <array>

#include "any_link.h"

namespace pcl_bv {
namespace {

template <typename T>
void add_cell(Cells<T>& cells, const Box<T>& box, std::uint32_t end) {
  cells.boxes.push_back(box);
  cells.begin.push_back(end);
}

// The points [begin, end) of one grid cell as one cell, or as one each when some pair of them may not be
// linked.
template <typename T, typename Key>
void add_grid_cell(Key key, std::uint32_t begin, std::uint32_t end, T r2, Cells<T>& cells,
                   std::vector<Key>& keys) {
  const Box<T> box = box_of(cells.points.data() + begin, end - begin);
  if (end - begin == 1 || greatest_squared_distance(box, box) < r2) {
    add_cell(cells, box, end);
    keys.push_back(key);
    return;
  }
  for (std::uint32_t i = begin; i < end; ++i) {
    add_cell(cells, {cells.points[i], cells.points[i]}, i + 1);
    keys.push_back(key);
  }
}

// A row of neighbours along x: its place and how far along x it reaches, in cells.
struct Row {
  int dz, dy, reach;
};

// Half of the 5 x 5 x 5 block around a cell; the other half sees the cell as its neighbour. Adjacent cells
// come first: they are mostly linked, and then most pairs of the outer shell share a component and cost
// nothing.
constexpr std::array<Row, 18> rows{{
    {0, 0, 1},
    {0, -1, 1},
    {-1, -1, 1},
    {-1, 0, 1},
    {-1, 1, 1},
    {0, 0, 2},
    {0, -1, 2},
    {0, -2, 2},
    {-1, -2, 2},
    {-1, -1, 2},
    {-1, 0, 2},
    {-1, 1, 2},
    {-1, 2, 2},
    {-2, -2, 2},
    {-2, -1, 2},
    {-2, 0, 2},
    {-2, 1, 2},
    {-2, 2, 2},
}};

// From a cell's key to that of the middle of its row of neighbours, modulo 2^bits as unsigned numbers go.
template <typename Key>
Key key_offset(const CellGrid& grid, const Row& row) {
  const auto along = [&grid](int cells, std::size_t axis) {
    return static_cast<Key>(static_cast<Key>(cells) << grid.shift[axis]);
  };
  return static_cast<Key>(along(row.dz, 2) + along(row.dy, 1));
}

template <typename T>
void join_if_linked(std::uint32_t a, std::uint32_t b, T r2, Cells<T>& cells, UnionFind& sets) {
  const std::uint32_t root_a = sets.find(a);
  const std::uint32_t root_b = sets.find(b);
  if (root_a == root_b) return;
  const auto group = [&cells](std::uint32_t cell) {
    return PointGroup<T>{cells.points.data() + cells.begin[cell], cells.count(cell), cells.boxes[cell]};
  };
  if (any_link(group(a), group(b), r2)) sets.unite_roots(root_a, root_b);
}

}  // namespace

template <typename T, typename Key>
void make_cells(const std::vector<Point<T>>& points, const CellGrid& grid, T r2, Cells<T>& cells,
                CellKeys<Key>& keys) {
  const auto n = static_cast<std::uint32_t>(points.size());
  keys.order.resize(n);
  for (std::uint32_t i = 0; i < n; ++i)
    keys.order[i] = {grid.key<Key>(points[i]), i};
  radix_sort(keys.order, keys.spare, grid.key_bits);

  cells.points.resize(n);
  for (std::uint32_t i = 0; i < n; ++i)
    cells.points[i] = points[keys.order[i].point];
  cells.begin.assign(1, 0);
  cells.boxes.clear();
  keys.keys.clear();
  for (std::uint32_t begin = 0, end = 0; begin < n; begin = end) {
    const Key key = keys.order[begin].key;
    while (end < n && keys.order[end].key == key)
      ++end;
    add_grid_cell(key, begin, end, r2, cells, keys.keys);
  }

  cells.cell_of_point.resize(n);
  for (std::uint32_t cell = 0; cell < cells.size(); ++cell) {
    for (std::uint32_t i = cells.begin[cell]; i < cells.begin[cell + 1]; ++i) {
      cells.cell_of_point[keys.order[i].point] = cell;
    }
  }
}

template <typename T, typename Key>
void join_cells(const CellGrid& grid, T r2, Cells<T>& cells, const std::vector<Key>& keys, UnionFind& sets) {
  for (const Row& row : rows) {
    const Key middle = key_offset<Key>(grid, row);
    const auto reach = static_cast<Key>(row.reach);
    std::uint32_t first = 0;  // Of the cells in the row; moves forward with the cell.
    for (std::uint32_t cell = 0; cell < cells.size(); ++cell) {
      const auto first_key = static_cast<Key>(keys[cell] + middle - reach);
      const auto last_key = static_cast<Key>(keys[cell] + middle + reach);
      while (keys[first] < first_key)
        ++first;
      for (std::uint32_t other = first; other < cell && keys[other] <= last_key; ++other) {
        if (!sets.surely_united(cell, other)) join_if_linked(cell, other, r2, cells, sets);
      }
    }
  }
}

// NOLINTBEGIN(bugprone-macro-parentheses): the arguments are types
#define PCL_BV_CELLS(T, Key)                                                                             \
  template void make_cells(const std::vector<Point<T>>&, const CellGrid&, T, Cells<T>&, CellKeys<Key>&); \
  template void join_cells(const CellGrid&, T, Cells<T>&, const std::vector<Key>&, UnionFind&);
// NOLINTEND(bugprone-macro-parentheses)
PCL_BV_CELLS(float, std::uint32_t)
PCL_BV_CELLS(float, std::uint64_t)
PCL_BV_CELLS(float, WideKey)
PCL_BV_CELLS(double, std::uint32_t)
PCL_BV_CELLS(double, std::uint64_t)
PCL_BV_CELLS(double, WideKey)
#undef PCL_BV_CELLS

}  // namespace pcl_bv
