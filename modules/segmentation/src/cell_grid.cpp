// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cell_grid.h"

#include <algorithm>
#include <bit>

namespace pcl_bv {

std::int64_t far_cell_number(double cells) {
  // The bits of a positive double grow with it, 2^52 to an octave; 2^28 remain, the step being 2^12 cells at
  // least.
  const auto steps = [](double v) { return std::bit_cast<std::int64_t>(v) >> 24; };
  const std::int64_t magnitude =
      static_cast<std::int64_t>(far_cells) + steps(std::abs(cells)) - steps(far_cells);
  return cells < 0 ? -magnitude : magnitude;
}

void CellGrid::add_axis(std::size_t axis, double min, double max) {
  constexpr std::int64_t spare = 4;  // A block's worth of cells.
  const std::int64_t low = cell_number(min, inverse_side);
  const std::int64_t high = cell_number(max, inverse_side);
  origin[axis] = low - spare;
  shift[axis] = key_bits;
  const std::int64_t last_block = (high + spare - origin[axis]) / 4;
  key_bits += static_cast<unsigned>(std::bit_width(static_cast<std::uint64_t>(last_block)));
  near = near && static_cast<double>(std::max(std::abs(low), std::abs(high))) < near_cells;
}

}  // namespace pcl_bv
