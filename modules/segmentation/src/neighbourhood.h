// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// All cells near a cell, on every side, where joining needs half of them only.
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

namespace pcl_bv {

/// By row: a variable for each, as clang allows a million steps for one.
template <int dy, int dz>
inline constexpr std::array<NearAndFar, 3> masks_of_row{near_and_far({-1, dy, dz}), near_and_far({0, dy, dz}),
                                                        near_and_far({1, dy, dz})};

/// By (dz + 1) * 3 + dy + 1, and there by dx + 1.
inline constexpr std::array<const std::array<NearAndFar, 3>*, 9> masks_around{
    &masks_of_row<-1, -1>, &masks_of_row<0, -1>, &masks_of_row<1, -1>,
    &masks_of_row<-1, 0>,  &masks_of_row<0, 0>,  &masks_of_row<1, 0>,
    &masks_of_row<-1, 1>,  &masks_of_row<0, 1>,  &masks_of_row<1, 1>};

/// Numbers of a block's neighbours and its own, by row * 3 + dx + 1.
using BlocksAround = std::array<std::uint32_t, 27>;
inline constexpr std::uint32_t no_block = std::numeric_limits<std::uint32_t>::max();
inline constexpr std::size_t own_block = 13;

/// Finds the neighbours of blocks asked for in ascending order: the place in each of nine rows moves forward.
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

/// Places of a cell's points.
struct PlaceRun {
  std::uint32_t begin, end;
};

/// The cells at most two away from one along each axis, without itself: those that touch it before the
/// others, those of its block before those of other blocks, each of the four kinds sought when asked for.
template <typename T>
class Neighbourhood {
 public:
  explicit Neighbourhood(const Cells<T>& cells) : cells_(cells) {}

  void start(unsigned bit) {
    bit_ = bit;
    kind_ = 0;
    count_ = 0;
  }

  /// Adds the next kind that has any; `wanted` says which cells of a block. False if there is none.
  template <typename Wanted>
  bool more(const BlocksAround& around, const Wanted& wanted) {
    const std::size_t before = count_;
    while (kind_ < 4 && count_ == before)
      add(around, wanted, kind_++);
    return count_ > before;
  }

  std::size_t size() const { return count_; }
  const PlaceRun& operator[](std::size_t i) const { return runs_[i]; }

 private:
  // A cell in the lower half of its block is never within two of the next block, nor one in the upper half
  // of the block before: seven others matter.
  template <typename Wanted>
  void add(const BlocksAround& around, const Wanted& wanted, unsigned kind) {
    const auto side = [this](unsigned shift) { return (bit_ >> shift & 3) < 2 ? 0U : 2U; };
    const unsigned first = kind % 2 == 0 ? 0 : 1;
    const unsigned last = kind % 2 == 0 ? 0 : 7;
    for (unsigned i = first; i <= last; ++i) {
      const unsigned x = (i & 1) != 0 ? side(0) : 1;
      const unsigned y = (i & 2) != 0 ? side(2) : 1;
      const unsigned z = (i & 4) != 0 ? side(4) : 1;
      const std::uint32_t block = around[9 * z + 3 * y + x];
      if (block == no_block) continue;
      const NearAndFar& masks = (*masks_around[3 * z + y])[x];
      add(cells_.blocks[block], (kind < 2 ? masks.near : masks.far)[bit_] & wanted(block));
    }
  }

  void add(const Block& block, std::uint64_t bits) {
    for (; bits != 0; bits &= bits - 1) {
      const std::uint32_t cell = block.cell(static_cast<unsigned>(std::countr_zero(bits)));
      runs_[count_++] = {cells_.begin[cell], cells_.begin[cell + 1]};
    }
  }

  const Cells<T>& cells_;
  unsigned bit_ = 0, kind_ = 0;
  std::size_t count_ = 0;
  std::array<PlaceRun, 124> runs_;  // The first count_.
};

}  // namespace pcl_bv
