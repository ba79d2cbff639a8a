// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <vector>

#include "any_link.h"
#include "block_index.h"
#include "cell_grid.h"
#include "radix_sort.h"

namespace pcl_bv {

/// Number of bits set: twelve instructions inline, where a call would be made for x86-64 without POPCNT.
inline std::uint32_t count_bits(std::uint64_t bits) {
  bits -= bits >> 1 & 0x5555555555555555U;
  bits = (bits & 0x3333333333333333U) + (bits >> 2 & 0x3333333333333333U);
  bits = (bits + (bits >> 4)) & 0x0f0f0f0f0f0f0f0fU;
  return static_cast<std::uint32_t>(bits * 0x0101010101010101U >> 56);
}

/// 4 x 4 x 4 cells, those that hold points numbered in the order of their bits.
struct Block {
  std::uint64_t occupied = 0;    ///< A bit for each cell that holds points.
  std::uint32_t first_cell = 0;  ///< Number of the first of them.
  bool united = false;           ///< Whether all points of the block are known to belong together.

  std::uint32_t cell(unsigned bit) const {
    return first_cell + count_bits(occupied & ((std::uint64_t{1} << bit) - 1));
  }
};

/// Points by cell.
template <typename T>
struct Cells {
  std::vector<Point<T>> points;      ///< Cell by cell.
  std::vector<std::uint32_t> begin;  ///< Where each cell begins in `points`; one entry more than cells.
  std::vector<Block> blocks;         ///< By ascending key.
  std::vector<std::uint32_t> node;   ///< Of each point of the array that the cells were made from.
  bool by_point = false;             ///< Nodes are places in `points` if true, else cells.

  std::uint32_t size() const { return static_cast<std::uint32_t>(begin.size() - 1); }
  PointRun<T> run(std::uint32_t cell) const {
    return {points.data() + begin[cell], begin[cell + 1] - begin[cell]};
  }
};

/// Keys of one width, and the room to sort them.
template <typename Key>
struct BlockKeys {
  std::vector<Key> keys;  ///< Of each block, ascending.
  std::vector<KeyedPoint<Key>> order, spare;
  BlockIndex<Key> index;
  std::vector<std::uint32_t> block_of_point, rank;
  std::vector<std::uint8_t> bit_of_point;
  std::vector<std::uint64_t> occupied;  ///< By number in `index`.
};

/// Sorts the points into the cells of `grid`; within a cell they keep their order. Reads cells.by_point.
template <typename T, typename Key>
void make_cells(const std::vector<Point<T>>& points, const CellGrid& grid, Cells<T>& cells,
                BlockKeys<Key>& keys);

}  // namespace pcl_bv
