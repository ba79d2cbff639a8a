// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Sorts points into the cells of a grid.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "any_link.h"
#include "block_index.h"
#include "cell_grid.h"
#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/parallel/parts.h"
#include "radix_sort.h"

namespace pcl_bv::detail {

/// Returns the number of bits set. Uses twelve inline instructions. On x86-64 without POPCNT, std::popcount()
/// would be a function call.
inline std::uint32_t count_bits(std::uint64_t bits) {
  bits -= bits >> 1 & 0x5555555555555555U;
  bits = (bits & 0x3333333333333333U) + (bits >> 2 & 0x3333333333333333U);
  bits = (bits + (bits >> 4)) & 0x0f0f0f0f0f0f0f0fU;
  return static_cast<std::uint32_t>(bits * 0x0101010101010101U >> 56);
}

/// A block of 4 x 4 x 4 cells. The occupied cells are numbered in the order of their bits.
struct Block {
  std::uint64_t occupied = 0;    ///< Has bit i set if cell i of the block holds points.
  std::uint32_t first_cell = 0;  ///< Number of the first occupied cell of the block.
  bool united = false;           ///< Links in the block connect all its points. False if nodes are points.

  std::uint32_t cell(unsigned bit) const {
    return first_cell + count_bits(occupied & ((std::uint64_t{1} << bit) - 1));
  }
};

/// Points sorted by cell. A node is a member of the sets that join_cells() joins.
template <typename T>
struct Cells {
  std::vector<Point<T>> points;      ///< Points in the order of their cells.
  std::vector<std::uint32_t> begin;  ///< Start of each cell in `points`; the last entry is points.size().
  std::vector<Block> blocks;         ///< Blocks in ascending order of their keys.
  std::vector<std::uint32_t> node;   ///< For each point passed to make_cells(), its node.
  bool by_point = false;             ///< Whether nodes are positions in `points`, not cells.

  std::uint32_t size() const { return static_cast<std::uint32_t>(begin.size() - 1); }
  PointRun<T> run(std::uint32_t cell) const {
    return {points.data() + begin[cell], begin[cell + 1] - begin[cell]};
  }
};

/// Consecutive points in the same block. Runs are long, because a sensor's next point is mostly in the same
/// block.
template <typename Key>
struct BlockRun {
  Key key;
  std::uint64_t occupied;  ///< The bits of the cells of these points.
  std::uint32_t begin;     ///< Index of the first point.
  std::uint32_t block;     ///< Number of the block in BlockKeys::index.
};

/// A part of the points. One thread sorts it.
template <typename Key>
struct CellPart {
  std::size_t begin, end;
  std::vector<BlockRun<Key>> runs;
  /// For each cell, first its number of points in this part, later the position of its next point.
  std::vector<std::uint32_t> next;
};

/// Smallest number of blocks for which the buffers of BlockKeys are freed after make_cells() instead of
/// retained for the next call. A street scene has about 10 000 blocks.
constexpr std::size_t free_memory_from_blocks = 1 << 18;

/// Keys of one width, and the buffers for sorting them.
template <typename Key>
struct BlockKeys {
  std::vector<Key> keys;  ///< Key of each block, ascending.
  PointParts<CellPart<Key>> parts;
  std::vector<KeyedPoint<Key>> order, spare;
  BlockIndex<Key> index;
  /// Position in `keys` of each block, indexed by the number of the block in `index`. `occupied` is indexed
  /// by the same number.
  std::vector<std::uint32_t> rank;
  std::vector<std::uint64_t> occupied;
  std::vector<std::uint8_t> bit_of_point;

  /// Frees all memory except that of `keys`.
  void release_memory() {
    BlockKeys only_keys;
    only_keys.keys.swap(keys);
    *this = std::move(only_keys);
  }
};

/// Sorts the points into the cells of `grid`. Within a cell, points retain their order. The caller must set
/// cells.by_point, which selects the nodes.
template <typename T, typename Key>
void make_cells(const std::vector<Point<T>>& points, const CellGrid& grid, const ParallelPolicy& policy,
                Cells<T>& cells, BlockKeys<Key>& keys);

}  // namespace pcl_bv::detail
