// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Divides the region of a cloud into boxes with limited numbers of points.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

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
  /// `anchor` is any point of the cloud. A point can affect the result for points up to `halo` away. Cells
  /// are 16 times as long. There are 2^21 along each axis; the outermost cells have no end.
  Bricks(const Coordinates& anchor, double halo);

  /// Returns the key of the cell of a point.
  std::uint64_t cell_key(const Coordinates& point) const { return key(position(point)); }
  /// Counts points of a cell. To be called for all points before divide().
  void count(std::uint64_t cell_key, std::uint64_t points) { cells_[cell_key].points += points; }

  /// Makes bricks of at most `max_points` own points. A single cell may exceed it.
  void divide(std::size_t max_points);

  std::size_t size() const { return size_; }

  /// The brick to which a point belongs, and the bricks whose points it can affect.
  struct Place {
    std::uint32_t own = 0;
    std::uint32_t others = 0;             ///< How many.
    std::array<std::uint32_t, 26> other;  ///< Their numbers.
  };
  /// The cell of the last point. Points that follow one another are mostly in the same cell.
  struct Cursor {
    std::uint64_t key = ~std::uint64_t{0};
    const Cell* cell = nullptr;
  };
  Place place(const Coordinates& point, Cursor& cursor) const;

 private:
  using Position = std::array<std::uint32_t, 3>;

  Coordinates relative(const Coordinates& point) const;
  Position position(const Coordinates& point) const;
  static std::uint64_t key(const Position& position);
  static Position position_of(std::uint64_t key);
  const Cell& cell_of(std::uint64_t key) const;
  const Cell* neighbour(const Position& position, int dx, int dy, int dz) const;

  Coordinates anchor_;
  double side_, per_side_, margin_;  // margin_: the halo in units of the side
  std::unordered_map<std::uint64_t, Cell> cells_;
  std::size_t size_ = 0;
};

}  // namespace pcl_bv::detail
