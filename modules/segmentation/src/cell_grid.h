// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Cell numbers of coordinates, and the blocks of 4 x 4 x 4 cells that the cells come in: neighbours are
// sought by block, and which of a block's cells hold points is one 64-bit word.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "distance.h"

namespace pcl_bv {

/// Keys of the grids that do not fit 64 bits; g++ and clang have this type on every 64-bit machine.
__extension__ using WideKey = unsigned __int128;

/// So many cells from the origin, cells start to grow with the distance.
constexpr double far_cells = 0x1p40;

/// Cells up to here are as wide as they should be to 2^-24 of their side.
constexpr double near_cells = 0x1p28;

/// cell_number() for |cells| >= far_cells.
std::int64_t far_cell_number(double cells);

/// Number of the cell in which `coordinate` lies: monotone, below 2^41 in magnitude for each valid
/// coordinate. Two coordinates less than 1.9 cells apart get numbers that differ by 2 at most.
///
/// Up to 2^40 cells from the origin this is floor(coordinate / side), in double to 2^-12 of a cell. Farther
/// out a cell spans 2^-28 of its distance: still finer than float's spacing, so that it holds one float value
/// only.
inline std::int64_t cell_number(double coordinate, double inverse_side) {
  const double cells = coordinate * inverse_side;
  if (!(std::abs(cells) < far_cells)) return far_cell_number(cells);
  const auto towards_zero = static_cast<std::int64_t>(cells);
  return towards_zero - (cells < static_cast<double>(towards_zero));
}

/// Where a cell is: the key of its block and its bit there, x lowest, then y, then z, two bits each.
template <typename Key>
struct CellPlace {
  Key block;
  std::uint8_t bit;
};

/// The blocks over a box. Keys order them by z, then y, then x. Each axis has a spare block on either side,
/// so that the key of a neighbour never carries into the next axis.
struct CellGrid {
  double inverse_side;
  std::array<std::int64_t, 3> origin;  ///< Cell number that becomes 0, along x, y, z.
  std::array<unsigned, 3> shift;       ///< Lowest bit of a block's x, y, z in the key.
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
  CellPlace<Key> place(const Point<T>& p) const {
    return near ? packed<Key>(near_cell(0, p.x), near_cell(1, p.y), near_cell(2, p.z))
                : packed<Key>(cell(0, p.x), cell(1, p.y), cell(2, p.z));
  }

 private:
  void add_axis(std::size_t axis, double min, double max);

  template <typename Key, typename Cell>
  CellPlace<Key> packed(Cell x, Cell y, Cell z) const {
    const auto block = [this](Cell c, std::size_t axis) { return static_cast<Key>(c >> 2) << shift[axis]; };
    return {static_cast<Key>(block(x, 0) | block(y, 1) | block(z, 2)),
            static_cast<std::uint8_t>((x & 3) | (y & 3) << 2 | (z & 3) << 4)};
  }

  std::int64_t cell(std::size_t axis, double coordinate) const {
    return cell_number(coordinate, inverse_side) - origin[axis];
  }

  // The same but for the last bits of where a cell ends: what is cut off is positive, so this is a floor,
  // too.
  std::int32_t near_cell(std::size_t axis, double coordinate) const {
    return static_cast<std::int32_t>(coordinate * inverse_side - static_cast<double>(origin[axis]));
  }
};

}  // namespace pcl_bv
