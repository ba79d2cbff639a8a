// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Cell numbers of coordinates and their packing into one sortable key.
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

/// The cells over a box. Keys order them by z, then y, then x. Each axis has two spare cells on either side,
/// so that the key of a neighbour never carries into the next axis.
struct CellGrid {
  double inverse_side;
  std::array<std::int64_t, 3> origin;  ///< Cell number that becomes 0, along x, y, z.
  std::array<unsigned, 3> shift;       ///< Lowest bit of x, y, z in the key.
  unsigned key_bits;                   ///< Width of the key, at most 126.

  template <typename T>
  CellGrid(const Box<T>& box, double inverse_of_side) : inverse_side(inverse_of_side), key_bits(0) {
    add_axis(0, box.min.x, box.max.x);
    add_axis(1, box.min.y, box.max.y);
    add_axis(2, box.min.z, box.max.z);
  }

  template <typename Key, typename T>
  Key key(const Point<T>& p) const {
    return static_cast<Key>(part<Key>(0, p.x) | part<Key>(1, p.y) | part<Key>(2, p.z));
  }

 private:
  void add_axis(std::size_t axis, double min, double max);

  template <typename Key>
  Key part(std::size_t axis, double coordinate) const {
    return static_cast<Key>(cell_number(coordinate, inverse_side) - origin[axis]) << shift[axis];
  }
};

}  // namespace pcl_bv
