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
 public:
  /// `anchor` is any point of the cloud. A point can decide on points up to `halo` away. Cells are 16 times
  /// as long. There are 2^21 along each axis; the outermost cells have no end.
  Bricks(const Coordinates& anchor, double halo);

  /// Counts a point. To be called for all points before divide().
  void count(const Coordinates& point);

  /// Makes bricks of at most `max_points` points, where a single cell does not have more.
  void divide(std::size_t max_points);

  std::size_t size() const { return size_; }

  /// The brick of a point, and the bricks of others on which it can decide.
  struct Place {
    std::uint32_t own = 0;
    std::uint32_t others = 0;             ///< How many.
    std::array<std::uint32_t, 26> other;  ///< Their numbers.
  };
  Place place(const Coordinates& point) const;

 private:
  struct Cell {
    std::uint64_t points = 0;
    std::uint32_t brick = 0;
    bool inner = false;  // all cells around it have the same brick or no points
  };
  using Position = std::array<std::uint32_t, 3>;

  Coordinates relative(const Coordinates& point) const;
  Position position(const Coordinates& point) const;
  static std::uint64_t key(const Position& position);
  static Position position_of(std::uint64_t key);
  const Cell* neighbour(const Position& position, int dx, int dy, int dz) const;

  Coordinates anchor_;
  double side_, margin_;  // margin_: the halo in units of the side
  std::unordered_map<std::uint64_t, Cell> cells_;
  std::uint64_t last_key_ = 0;  // of the cell of the last call of count()
  Cell* last_cell_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace pcl_bv::detail
