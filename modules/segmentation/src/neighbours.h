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

constexpr CellMasks cells_within(const BlockOffset& offset, int least, int most) {
  CellMasks masks{};
  const auto distance = [](int from, int to) { return from < to ? to - from : from - to; };
  const auto greater = [](int a, int b) { return a > b ? a : b; };
  for (int a = 0; a < 64; ++a) {
    for (int b = 0; b < 64; ++b) {
      const int x = distance(a & 3, (b & 3) + 4 * offset.dx);
      const int y = distance(a >> 2 & 3, (b >> 2 & 3) + 4 * offset.dy);
      const int z = distance(a >> 4, (b >> 4) + 4 * offset.dz);
      const int steps = greater(x, greater(y, z));
      if (steps >= least && steps <= most) masks[a] |= std::uint64_t{1} << b;
    }
  }
  return masks;
}

/// Cells that touch and cells two away: the former are mostly linked, so they are asked first.
struct NearAndFar {
  CellMasks near, far;
};

constexpr NearAndFar near_and_far(const BlockOffset& offset) {
  return {cells_within(offset, 1, 1), cells_within(offset, 2, 2)};
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
