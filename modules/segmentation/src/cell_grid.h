// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Numbers of cells and of blocks of 4 x 4 x 4 cells. Neighbours are searched by block. The bits of a 64-bit
// word mark the cells of a block that hold points.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "distance.h"

namespace pcl_bv::detail {

/// Type of keys that need more than 64 bits. g++ and clang have it on every 64-bit machine.
__extension__ using WideKey = unsigned __int128;

/// Smallest distance from the origin, in cells, at which the size of a cell grows with the distance.
constexpr double far_cells = 0x1p40;

/// Largest distance from the origin, in cells, at which the width of a cell is correct to 2^-24 of the width.
constexpr double near_cells = 0x1p28;

/// Returns cell_number() for |cells| >= far_cells.
std::int64_t far_cell_number(double cells);

/// Returns the number of the cell of a coordinate. The number is monotone in the coordinate and below 2^41 in
/// magnitude for each valid coordinate. Two coordinates less than 1.9 cells apart get numbers that differ by
/// at most 2.
///
/// At a distance below 2^40 cells from the origin the number is floor(coordinate / side), computed in double
/// with an error of at most 2^-12 of a cell. Farther out the width of a cell is at most 2^-28 of its distance
/// from the origin. This is finer than the spacing of floats, so a cell holds at most one float value.
inline std::int64_t cell_number(double coordinate, double inverse_side) {
  const double cells = coordinate * inverse_side;
  if (!(std::abs(cells) < far_cells)) return far_cell_number(cells);
  const auto towards_zero = static_cast<std::int64_t>(cells);
  return towards_zero - (cells < static_cast<double>(towards_zero));
}

/// Position of a cell, given by the key of its block and its number in the block. The number has two bits per
/// axis. Those of x are the lowest, then come y and z.
template <typename Key>
struct CellKey {
  Key block;
  std::uint8_t bit;
};

/// The blocks that cover a box. Keys order blocks by z, then y, then x. Each axis has a spare block on either
/// side, so that the key of a neighbour never carries into the next axis.
struct CellGrid {
  double inverse_side;
  std::array<std::int64_t, 3> origin;  ///< Along x, y, z, the cell_number() of cell 0 of the grid.
  std::array<unsigned, 3> shift;       ///< Position of the lowest bit of x, y, z in the key.
  unsigned key_bits;                   ///< Width of the key, at most 120.
  bool near;                           ///< Whether all cell numbers are below near_cells in magnitude.

  template <typename T>
  CellGrid(const Box<T>& box, double inverse_of_side)
      : inverse_side(inverse_of_side), key_bits(0), near(true) {
    add_axis(0, box.min.x, box.max.x);
    add_axis(1, box.min.y, box.max.y);
    add_axis(2, box.min.z, box.max.z);
  }

  template <typename Key, typename T>
  CellKey<Key> key_of(const Point<T>& p) const {
    return near ? packed<Key>(near_cell(0, p.x), near_cell(1, p.y), near_cell(2, p.z))
                : packed<Key>(cell(0, p.x), cell(1, p.y), cell(2, p.z));
  }

 private:
  void add_axis(std::size_t axis, double min, double max);

  template <typename Key, typename Cell>
  CellKey<Key> packed(Cell x, Cell y, Cell z) const {
    const auto block = [this](Cell c, std::size_t axis) { return static_cast<Key>(c >> 2) << shift[axis]; };
    return {static_cast<Key>(block(x, 0) | block(y, 1) | block(z, 2)),
            static_cast<std::uint8_t>((x & 3) | (y & 3) << 2 | (z & 3) << 4)};
  }

  std::int64_t cell(std::size_t axis, double coordinate) const {
    return cell_number(coordinate, inverse_side) - origin[axis];
  }

  // Returns the same as cell(), except for rounding at the boundaries of cells. The converted number is
  // positive, so truncation rounds down.
  std::int32_t near_cell(std::size_t axis, double coordinate) const {
    return static_cast<std::int32_t>(coordinate * inverse_side - static_cast<double>(origin[axis]));
  }
};

}  // namespace pcl_bv::detail
