// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "brick_grid.h"

#include <cmath>

namespace pcl_bv::detail {
namespace {

constexpr unsigned kAxisBits = 21;
constexpr std::int64_t kCells = std::int64_t{1} << kAxisBits;  // along an axis

std::uint64_t key_of(std::int64_t x, std::int64_t y, std::int64_t z) {
  const auto number = [](std::int64_t i) { return static_cast<std::uint64_t>(i) & (kCells - 1); };
  return number(x) << (2 * kAxisBits) | number(y) << kAxisBits | number(z);
}

}  // namespace

BrickGrid::BrickGrid(double halo, double halos)
    // Grids of the same halo end at the same coordinates, so that first_quarter() holds for all points.
    : per_side_(1 / (halos * halo)), margin_((1 + 1e-9) / halos), end_(0x1p49 / halos) {}

GridCell BrickGrid::cell_of(const std::array<double, 3>& at) const {
  GridCell cell;
  std::array<std::int64_t, 3> number;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cell.begin[axis] = std::floor(at[axis]);
    cell.end[axis] = cell.begin[axis] + 1;
    // Scaling rounds by less than 2^-52 of the number.
    cell.margin[axis] = margin_ + (std::fabs(cell.begin[axis]) + 1) * 0x1p-51;
    number[axis] = static_cast<std::int64_t>(cell.begin[axis]) + kCells / 2;
  }
  cell.key = key_of(number[0], number[1], number[2]);
  return cell;
}

std::uint64_t BrickGrid::neighbour(std::uint64_t key, int dx, int dy, int dz) {
  const std::array<std::uint32_t, 3> at = position(key);
  return key_of(std::int64_t{at[0]} + dx, std::int64_t{at[1]} + dy, std::int64_t{at[2]} + dz);
}

std::uint64_t BrickGrid::first_quarter(std::uint64_t key) {
  const std::array<std::uint32_t, 3> at = position(key);
  const auto first = [](std::uint32_t number) {
    return 4 * (std::int64_t{number} - kCells / 2) + kCells / 2;
  };
  return key_of(first(at[0]), first(at[1]), first(at[2]));
}

std::array<std::uint32_t, 3> BrickGrid::position(std::uint64_t key) {
  const auto number = [](std::uint64_t i) { return static_cast<std::uint32_t>(i & (kCells - 1)); };
  return {number(key >> (2 * kAxisBits)), number(key >> kAxisBits), number(key)};
}

}  // namespace pcl_bv::detail
