// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The grid of cells that bricks consist of.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "pcl_bv/numeric/coordinates.h"

namespace pcl_bv::detail {

/// A cell of a BrickGrid.
struct GridCell {
  std::uint64_t key = 0;
  std::array<double, 3> begin{1, 1, 1}, end{};  ///< In units of cells. Of no point by default.
  std::array<double, 3> margin{};               ///< The halo in units of cells, with the error of rounding.

  bool contains(const std::array<double, 3>& at) const {
    bool inside = true;  // without branches
    for (std::size_t axis = 0; axis < 3; ++axis) {
      inside &= at[axis] >= begin[axis];
      inside &= at[axis] < end[axis];
    }
    return inside;
  }
};

/// A grid of cubes around the origin. Cells are numbered modulo 2^21 along each axis, so cells that are
/// multiples of 2^21 apart have the same key. Points that are at most a halo apart are in the same cell or in
/// adjacent cells.
class BrickGrid {
 public:
  /// The side of a cell is `halos` >= 4 times the halo, which must be greater than 0.
  BrickGrid(double halo, double halos);

  /// Returns a position in units of cells.
  std::array<double, 3> scaled(const Coordinates& point) const {
    return {scaled(point.x), scaled(point.y), scaled(point.z)};
  }
  /// Returns the cell of a scaled position.
  GridCell cell_of(const std::array<double, 3>& at) const;

  /// Returns the key of the cell that is dx, dy, dz cells away.
  static std::uint64_t neighbour(std::uint64_t key, int dx, int dy, int dz);

  /// Returns the key of the first of the 4 x 4 x 4 cells that a cell has in a grid of a quarter of the side.
  static std::uint64_t first_quarter(std::uint64_t key);

  /// Returns the numbers of a cell along the axes, from 0 on.
  static std::array<std::uint32_t, 3> position(std::uint64_t key);

 private:
  double scaled(double x) const {
    const double at = x * per_side_;
    return at < -end_ ? -end_ : at > end_ ? end_ : at;
  }

  double per_side_, margin_;
  double end_;  // beyond, fractions of a cell would be rounded too much
};

}  // namespace pcl_bv::detail
