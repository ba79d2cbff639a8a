// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The occupied cells of a cloud and their joining into components.
#pragma once

#include <cstdint>
#include <vector>

#include "cell_grid.h"
#include "distance.h"
#include "radix_sort.h"
#include "union_find.h"

namespace pcl_bv {

/// Points by cell. All points of a cell belong together.
template <typename T>
struct Cells {
  std::vector<Point<T>> points;              ///< Cell by cell.
  std::vector<std::uint32_t> begin;          ///< Where each cell begins in `points`; size() + 1 entries.
  std::vector<Box<T>> boxes;                 ///< Of each cell's points.
  std::vector<std::uint32_t> cell_of_point;  ///< By position in the array that the cells were made from.

  std::uint32_t size() const { return static_cast<std::uint32_t>(boxes.size()); }
  std::uint32_t count(std::uint32_t cell) const { return begin[cell + 1] - begin[cell]; }
};

/// Keys of one width, and the room to sort them.
template <typename Key>
struct CellKeys {
  std::vector<Key> keys;  ///< Of each cell, ascending.
  std::vector<KeyedPoint<Key>> order, spare;
};

/// Sorts the points into cells of `grid`. Where rounding lets two points of a grid cell be r apart after all
/// (squares near the smallest float, doubles 10^12 cells out), each of its points becomes a cell with the
/// same key.
template <typename T, typename Key>
void make_cells(const std::vector<Point<T>>& points, const CellGrid& grid, T r2, Cells<T>& cells,
                CellKeys<Key>& keys);

/// Joins in `sets`, which holds each cell by itself, the cells that have linked points. A pair d2 < r2 may
/// span two cells along each axis, so all 124 neighbours are asked. The order of points within a cell
/// changes.
template <typename T, typename Key>
void join_cells(const CellGrid& grid, T r2, Cells<T>& cells, const std::vector<Key>& keys, UnionFind& sets);

}  // namespace pcl_bv
