// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Which cells of a block, or of the one beside it, are near a cell: as masks, worked out by the compiler.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace pcl_bv {

/// From a block to its neighbour, in blocks.
struct BlockOffset {
  int dx, dy, dz;
};

/// A row of three neighbours along x: dx = -1, 0, 1.
struct BlockRow {
  int dy, dz;
};

/// Half of the 26 neighbours; the other half sees the block as its neighbour. Of the first row only dx = -1
/// comes before the block itself.
inline constexpr std::array<BlockRow, 5> half_of_neighbours{{{0, 0}, {-1, 0}, {0, -1}, {-1, -1}, {1, -1}}};

/// For each cell of a block, the cells of another one.
using CellMasks = std::array<std::uint64_t, 64>;

/// The cells whose coordinate in bits [shift, shift + 2) is at most so far from `own` in the block before.
constexpr std::uint64_t cells_along(int shift, int own, int offset, int most) {
  std::uint64_t mask = 0;
  for (int b = 0; b < 64; ++b) {
    const int difference = (b >> shift & 3) + 4 * offset - own;
    if (difference >= -most && difference <= most) mask |= std::uint64_t{1} << b;
  }
  return mask;
}

/// By axis, which takes few steps of a compiler's constant evaluation: clang allows a million.
constexpr CellMasks cells_up_to(const BlockOffset& offset, int most) {
  std::array<std::array<std::uint64_t, 4>, 3> along{};
  for (int own = 0; own < 4; ++own) {
    along[0][own] = cells_along(0, own, offset.dx, most);
    along[1][own] = cells_along(2, own, offset.dy, most);
    along[2][own] = cells_along(4, own, offset.dz, most);
  }
  CellMasks masks{};
  for (int a = 0; a < 64; ++a)
    masks[a] = along[0][a & 3] & along[1][a >> 2 & 3] & along[2][a >> 4];
  return masks;
}

/// Cells that touch and cells two away: the former are mostly linked, so they are asked first.
struct NearAndFar {
  CellMasks near, far;
};

constexpr NearAndFar near_and_far(const BlockOffset& offset) {
  const CellMasks same = cells_up_to(offset, 0), one = cells_up_to(offset, 1), two = cells_up_to(offset, 2);
  NearAndFar result{};
  for (std::size_t a = 0; a < 64; ++a) {
    result.near[a] = one[a] & ~same[a];
    result.far[a] = two[a] & ~one[a];
  }
  return result;
}

inline constexpr NearAndFar within_block = near_and_far({0, 0, 0});

/// By row and dx + 1.
inline constexpr std::array<std::array<NearAndFar, 3>, half_of_neighbours.size()> beside_block = [] {
  std::array<std::array<NearAndFar, 3>, half_of_neighbours.size()> all{};
  for (std::size_t row = 0; row < all.size(); ++row) {
    for (int dx = -1; dx <= 1; ++dx)
      all[row][dx + 1] = near_and_far({dx, half_of_neighbours[row].dy, half_of_neighbours[row].dz});
  }
  return all;
}();

}  // namespace pcl_bv
