// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Divides the region of a cloud into boxes with limited numbers of points.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "brick_grid.h"
#include "pcl_bv/numeric/coordinates.h"

namespace pcl_bv::detail {

/// Bricks are boxes of cells of a grid. Each cell with points belongs to one brick.
class Bricks {
 private:
  struct Cell {
    std::uint64_t points = 0;
    std::uint32_t brick = 0;
    bool inner = false;  // all cells around it have the same brick or no points
  };

 public:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  explicit Bricks(const BrickGrid& grid) : grid_(grid) {}

  const BrickGrid& grid() const { return grid_; }

  /// Counts points of a cell. To be called for all points before divide().
  void count(std::uint64_t cell_key, std::uint64_t points) { cells_[cell_key].points += points; }

  /// Returns the keys of the cells with points.
  std::vector<std::uint64_t> cells() const;

  /// Makes bricks of at most `max_points` own points. A single cell may exceed it.
  void divide(std::size_t max_points);

  std::size_t size() const { return first_point_.size() - 1; }

  /// Returns the number of points that belong to earlier bricks. `brick` can be size().
  std::uint64_t points_before(std::uint32_t brick) const { return first_point_[brick]; }

  /// The brick to which a point belongs, and the bricks whose points it can affect.
  struct Place {
    std::uint32_t own = kNone;            ///< kNone if no point was counted in the cell of the point.
    std::uint32_t others = 0;             ///< How many.
    std::array<std::uint32_t, 26> other;  ///< Their numbers.
  };
  /// The cell of the last point. Points that follow one another are mostly in the same cell.
  struct Cursor {
    GridCell at;
    const Cell* cell = nullptr;
  };
  Place place(const Coordinates& point, Cursor& cursor) const;

 private:
  const Cell* find(std::uint64_t key) const;
  bool is_inner(std::uint64_t key, const Cell& cell) const;

  BrickGrid grid_;
  std::unordered_map<std::uint64_t, Cell> cells_;
  std::vector<std::uint64_t> first_point_ = {0};  // of each brick; then the number of all points
};

}  // namespace pcl_bv::detail
