// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Numbers of cells and of blocks of 4 x 4 x 4 cells. Neighbours are searched by block. The bits of a 64-bit
// word mark the cells of a block that hold points.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "distance.h"

namespace pcl_bv::detail {

/// Type of keys that need more than 64 bits. g++ and clang have it on every 64-bit machine.
__extension__ using WideKey = unsigned __int128;

/// Largest distance from the origin, in cells, at which the width of a cell is correct to 2^-24 of the width.
constexpr double near_cells = 0x1p28;

/// Returns the number of the cell of a coordinate. The number is monotone in the coordinate and below 2^62 in
/// magnitude for each valid coordinate. Two coordinates less than 2 cells apart get numbers that differ by at
/// most 2.
///
/// At a distance below 2^53 cells from the origin the number is floor(coordinate / side), without rounding.
/// Farther out, where the spacing of doubles is more than a cell, each double has a number of its own.
std::int64_t cell_number(double coordinate, double inverse_side);

/// Position of a cell, given by the key of its block and its number in the block. The number has two bits per
/// axis. Those of x are the lowest, then come y and z.
template <typename Key>
struct CellKey {
  Key block;
  std::uint8_t bit;
};

/// The blocks that cover a box. Keys order blocks by z, then y, then x. Each axis has a spare block on either
/// side, so that the key of a neighbour never carries into the next axis.
///
/// Cells are numbered from the low end of the box if all are near the origin. Otherwise the blocks along an
/// axis that have points are numbered in ascending order. A number is left out between blocks that are not
/// adjacent. So keys are short for any extent.
struct CellGrid {
  double inverse_side;
  std::array<std::int64_t, 3> origin;  ///< Along x, y, z, the cell_number() of cell 0, if `near`.
  std::array<unsigned, 3> shift;       ///< Position of the lowest bit of x, y, z in the key.
  unsigned key_bits;                   ///< Width of the key, at most 99.
  bool near;                           ///< Whether all cell numbers are below near_cells in magnitude.

  /// Makes the grid of points in a box. O(1) if the grid is `near`, else O(n log n).
  template <typename T>
  CellGrid(const std::vector<Point<T>>& points, const Box<T>& box, double inverse_of_side);

  template <typename Key, typename T>
  CellKey<Key> key_of(const Point<T>& p) const {
    return near ? packed<Key>(near_cell(0, p.x), near_cell(1, p.y), near_cell(2, p.z))
                : packed<Key>(far_cell(0, p.x), far_cell(1, p.y), far_cell(2, p.z));
  }

 private:
  /// A block along one axis, by the number that its cells have and by its number in the key.
  struct FarBlock {
    std::int64_t number, in_key;
  };

  void add_axis(std::size_t axis, std::int64_t low, std::int64_t high);
  void add_far_axis(std::size_t axis, std::vector<std::int64_t>& numbers);
  std::int64_t far_cell(std::size_t axis, double coordinate) const;

  template <typename Key, typename Cell>
  CellKey<Key> packed(Cell x, Cell y, Cell z) const {
    const auto block = [this](Cell c, std::size_t axis) { return static_cast<Key>(c >> 2) << shift[axis]; };
    return {static_cast<Key>(block(x, 0) | block(y, 1) | block(z, 2)),
            static_cast<std::uint8_t>((x & 3) | (y & 3) << 2 | (z & 3) << 4)};
  }

  // Returns cell_number() - origin, except for rounding at the boundaries of cells. The converted number is
  // positive, so truncation rounds down.
  std::int32_t near_cell(std::size_t axis, double coordinate) const {
    return static_cast<std::int32_t>(coordinate * inverse_side - static_cast<double>(origin[axis]));
  }

  std::array<std::vector<FarBlock>, 3> far_blocks_;  // ascending; empty if `near`
};

}  // namespace pcl_bv::detail
