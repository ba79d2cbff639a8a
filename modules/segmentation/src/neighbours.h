// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Masks of the cells near a cell, in the block of the cell or in a neighbouring block. They are computed at
// compile time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace pcl_bv::detail {

/// Offset from a block to its neighbour, in blocks.
struct BlockOffset {
  int dx, dy, dz;
};

/// A row of three neighbours along x, with dx = -1, 0 and 1.
struct BlockRow {
  int dy, dz;
};

/// Rows with half of the 26 neighbours: those that precede the block in the order of keys. So each pair of
/// blocks is visited once. In the first row, only the neighbour with dx = -1 precedes the block.
inline constexpr std::array<BlockRow, 5> half_of_neighbours{{{0, 0}, {-1, 0}, {0, -1}, {-1, -1}, {1, -1}}};

/// For each cell of a block, a set of cells of another block.
using CellMasks = std::array<std::uint64_t, 64>;

/// Returns the cells of another block that are at most `max_distance` from a cell along one axis. The
/// coordinate on this axis is in bits [shift, shift + 2) of a cell number. `own` is the coordinate of the
/// cell. `offset` is the offset of the other block.
constexpr std::uint64_t cells_within_on_axis(int shift, int own, int offset, int max_distance) {
  std::uint64_t mask = 0;
  for (int b = 0; b < 64; ++b) {
    const int difference = (b >> shift & 3) + 4 * offset - own;
    if (difference >= -max_distance && difference <= max_distance) mask |= std::uint64_t{1} << b;
  }
  return mask;
}

/// Returns, for each cell, the cells of the other block at most `max_distance` away along each axis. clang
/// limits the evaluation of a constant to a million steps. Therefore each axis is computed separately, which
/// takes few steps.
constexpr CellMasks cells_within(const BlockOffset& offset, int max_distance) {
  std::array<std::array<std::uint64_t, 4>, 3> on_axis{};
  for (int own = 0; own < 4; ++own) {
    on_axis[0][own] = cells_within_on_axis(0, own, offset.dx, max_distance);
    on_axis[1][own] = cells_within_on_axis(2, own, offset.dy, max_distance);
    on_axis[2][own] = cells_within_on_axis(4, own, offset.dz, max_distance);
  }
  CellMasks masks{};
  for (int a = 0; a < 64; ++a)
    masks[a] = on_axis[0][a & 3] & on_axis[1][a >> 2 & 3] & on_axis[2][a >> 4];
  return masks;
}

/// Masks of the cells that touch a cell, and of the cells that are two cells away. Touching cells are mostly
/// linked, so they are tested first.
struct TouchingAndNext {
  CellMasks touching, two_away;
};

constexpr TouchingAndNext touching_and_next(const BlockOffset& offset) {
  const CellMasks same = cells_within(offset, 0), one = cells_within(offset, 1),
                  two = cells_within(offset, 2);
  TouchingAndNext result{};
  for (std::size_t a = 0; a < 64; ++a) {
    result.touching[a] = one[a] & ~same[a];
    result.two_away[a] = two[a] & ~one[a];
  }
  return result;
}

inline constexpr TouchingAndNext within_block = touching_and_next({0, 0, 0});

/// Masks for half_of_neighbours. The first index is the row, the second index is dx + 1.
inline constexpr std::array<std::array<TouchingAndNext, 3>, half_of_neighbours.size()> next_to_block = [] {
  std::array<std::array<TouchingAndNext, 3>, half_of_neighbours.size()> all{};
  for (std::size_t row = 0; row < all.size(); ++row) {
    for (int dx = -1; dx <= 1; ++dx)
      all[row][dx + 1] = touching_and_next({dx, half_of_neighbours[row].dy, half_of_neighbours[row].dz});
  }
  return all;
}();

}  // namespace pcl_bv::detail
