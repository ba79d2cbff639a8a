// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "any_link.h"
#include "block_index.h"
#include "cell_grid.h"
#include "pcl_bv/parallel/parts.h"
#include "pcl_bv/parallel/policy.h"
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

/// Points in a row, all in one block: a sensor mostly stays in the block of the point before.
template <typename Key>
struct BlockRun {
  Key key;
  std::uint64_t occupied;  ///< Cells of these points.
  std::uint32_t begin;     ///< The first of them.
  std::uint32_t block;     ///< The block's number in BlockKeys::index.
};

/// Points that one thread takes.
template <typename Key>
struct CellPart {
  std::size_t begin, end;
  std::vector<BlockRun<Key>> runs;
  std::vector<std::uint32_t> next;  ///< By cell, where the next one goes.
};

/// From this many blocks on, the memory that found them is freed at once. A street has 10 000.
constexpr std::size_t many_blocks = 1 << 18;

/// Keys of one width, and the room to sort them.
template <typename Key>
struct BlockKeys {
  std::vector<Key> keys;  ///< Of each block, ascending.
  Parts<CellPart<Key>> parts;
  std::vector<KeyedPoint<Key>> order, spare;
  BlockIndex<Key> index;
  std::vector<std::uint32_t> rank;  ///< By number in `index`, as is the next one.
  std::vector<std::uint64_t> occupied;
  std::vector<std::uint8_t> bit_of_point;

  /// Frees all but `keys`.
  void release_memory() {
    BlockKeys kept;
    kept.keys.swap(keys);
    *this = std::move(kept);
  }
};

/// Sorts the points into the cells of `grid`; within a cell they keep their order. Reads cells.by_point.
template <typename T, typename Key>
void make_cells(const std::vector<Point<T>>& points, const CellGrid& grid, const ParallelPolicy& policy,
                Cells<T>& cells, BlockKeys<Key>& keys);

}  // namespace pcl_bv
