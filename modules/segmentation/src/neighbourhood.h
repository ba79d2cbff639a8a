// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The cells around a cell, on all sides. Joining cells needs only half of them (see neighbours.h).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "cells.h"
#include "neighbours.h"

namespace pcl_bv::detail {

/// Masks for one row of blocks. clang limits the evaluation of a constant to a million steps, so each row is
/// a separate constant.
template <int dy, int dz>
inline constexpr std::array<CellMasks, 3> masks_of_row{
    cells_within({-1, dy, dz}, 2), cells_within({0, dy, dz}, 2), cells_within({1, dy, dz}, 2)};

/// Masks for all blocks around a block. The first index is (dz + 1) * 3 + dy + 1, the second index is dx + 1.
inline constexpr std::array<const std::array<CellMasks, 3>*, 9> masks_around{
    &masks_of_row<-1, -1>, &masks_of_row<0, -1>, &masks_of_row<1, -1>,
    &masks_of_row<-1, 0>,  &masks_of_row<0, 0>,  &masks_of_row<1, 0>,
    &masks_of_row<-1, 1>,  &masks_of_row<0, 1>,  &masks_of_row<1, 1>};

/// Numbers of the blocks around a block and of the block itself. The index is ((dz + 1) * 3 + dy + 1) * 3 +
/// dx + 1.
using BlocksAround = std::array<std::uint32_t, 27>;
inline constexpr std::uint32_t no_block = std::numeric_limits<std::uint32_t>::max();
inline constexpr std::size_t own_block = 13;

/// Finds the blocks around a block. Call find() for blocks in ascending order: in each of the nine rows,
/// find() continues at the index next_[row], where the previous call ended.
template <typename Key>
class BlockRows {
 public:
  BlockRows(const CellGrid& grid, const std::vector<Key>& keys, std::size_t first_block) : keys_(keys) {
    const auto along = [&grid](int blocks, std::size_t axis) {
      return static_cast<Key>(static_cast<Key>(blocks) << grid.shift[axis]);
    };
    for (int row = 0; row < 9; ++row) {
      const auto i = static_cast<std::size_t>(row);
      offset_[i] = static_cast<Key>(along(row / 3 - 1, 2) + along(row % 3 - 1, 1) + along(-1, 0));
      const Key key = static_cast<Key>(keys[first_block] + offset_[i]);
      next_[i] = static_cast<std::size_t>(std::lower_bound(keys.begin(), keys.end(), key) - keys.begin());
    }
  }

  void find(std::size_t block, BlocksAround& around) {
    around.fill(no_block);
    for (std::size_t row = 0; row < 9; ++row) {
      const Key key = static_cast<Key>(keys_[block] + offset_[row]);
      std::size_t& next = next_[row];
      while (next < keys_.size() && keys_[next] < key)
        ++next;
      for (std::size_t i = next; i < keys_.size() && keys_[i] - key <= 2; ++i)
        around[3 * row + static_cast<std::size_t>(keys_[i] - key)] = static_cast<std::uint32_t>(i);
    }
  }

 private:
  const std::vector<Key>& keys_;
  std::array<Key, 9> offset_{};
  std::array<std::size_t, 9> next_{};
};

/// A range of positions in Cells::points. It holds the points of consecutive cells of a block.
struct PositionRange {
  std::uint32_t begin, end;
};

/// The points in the cells at most two cells away from a cell along each axis, including the cell itself.
/// start() takes the points in the block of the cell. add_other_blocks() adds the points in other blocks.
/// Consecutive occupied cells of a block form one run, so the 125 cells mostly have about ten runs.
template <typename T>
class Neighbourhood {
 public:
  explicit Neighbourhood(const Cells<T>& cells) : cells_(cells) {}

  /// Starts at cell `bit` of the block in the middle of `around`. `around` must outlive this object. If
  /// `allowed_cells` is not null, element b has a bit for each cell of block b. Cells whose bit is not set
  /// are skipped.
  void start(const BlocksAround& around, unsigned bit, const std::uint64_t* allowed_cells = nullptr) {
    around_ = &around;
    allowed_cells_ = allowed_cells;
    bit_ = bit;
    count_ = 0;
    points_ = 0;
    add(1, 1, 1);
    has_other_blocks_ = false;
  }

  /// Adds the runs in other blocks. These are at most seven blocks. Along an axis, a cell in the lower half
  /// of its block is never within two cells of the next block. A cell in the upper half is never within two
  /// cells of the previous block.
  void add_other_blocks() {
    if (has_other_blocks_) return;
    has_other_blocks_ = true;
    const auto side = [this](unsigned shift) { return (bit_ >> shift & 3) < 2 ? 0U : 2U; };
    for (unsigned i = 1; i < 8; ++i)
      add((i & 1) != 0 ? side(0) : 1, (i & 2) != 0 ? side(2) : 1, (i & 4) != 0 ? side(4) : 1);
  }

  std::size_t size() const { return count_; }
  std::size_t points() const { return points_; }  ///< Number of points in all runs.
  const PositionRange& operator[](std::size_t i) const { return runs_[i]; }

 private:
  void add(unsigned x, unsigned y, unsigned z) {
    const std::uint32_t number = (*around_)[9 * z + 3 * y + x];
    if (number == no_block) return;
    const Block& block = cells_.blocks[number];
    std::uint64_t mask = (*masks_around[3 * z + y])[x][bit_];
    if (allowed_cells_ != nullptr) mask &= allowed_cells_[number];
    std::uint64_t rest = mask & block.occupied;
    while (rest != 0) {
      const std::uint64_t others = block.occupied & ~mask & ~((rest & -rest) - 1);
      const std::uint64_t before = others == 0 ? ~std::uint64_t{0} : (others & -others) - 1;
      const std::uint32_t first = block.cell(static_cast<unsigned>(std::countr_zero(rest)));
      const PositionRange run{cells_.begin[first], cells_.begin[first + count_bits(rest & before)]};
      runs_[count_++] = run;
      points_ += run.end - run.begin;
      rest &= ~before;
    }
  }
  const Cells<T>& cells_;
  const BlocksAround* around_ = nullptr;
  const std::uint64_t* allowed_cells_ = nullptr;
  unsigned bit_ = 0;
  bool has_other_blocks_ = false;
  std::size_t count_ = 0, points_ = 0;
  std::array<PositionRange, 125> runs_;  // only the first count_ entries are set
};

}  // namespace pcl_bv::detail
