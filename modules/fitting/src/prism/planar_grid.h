// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Points of a plane in the cells of a grid.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_bv::detail {

/// The distinct points of a plane, sorted into at most 2^16 cells of equal size. Duplicates are removed. The
/// stored order does not depend on the input order.
class PlanarGrid {
 public:
  /// Coordinates must be finite, and there must be at least one point.
  explicit PlanarGrid(const std::vector<Eigen::Vector2d>& points);

  const std::vector<Eigen::Vector2d>& points() const { return points_; }
  const Eigen::Vector2d& cell_size() const { return size_; }

  /// Returns the position of a point in points(). The point must be one of these.
  std::uint32_t find(const Eigen::Vector2d& point) const;

  /// An upper bound of how far a point can be outside of its cell, because the corners of cells are rounded.
  double rounding() const { return rounding_; }

  /// Calls visit(begin, end, low, high) for each cell that is not empty and whose range of coordinates meets
  /// the box from `low` to `high`, until visit() returns true. The positions of the cell's points are from
  /// `begin` to `end` - 1. The corners of the cell are rounded. Every point in the box is in one of these
  /// cells.
  template <typename Visit>
  void visit_cells(const Eigen::Vector2d& low, const Eigen::Vector2d& high, const Visit& visit) const {
    const std::size_t end_column = cell(high.x(), 0), end_row = cell(high.y(), 1);
    for (std::size_t row = cell(low.y(), 1); row <= end_row; ++row) {
      for (std::size_t column = cell(low.x(), 0); column <= end_column; ++column) {
        const std::uint32_t* const first = &first_[row * counts_[0] + column];
        if (first[0] == first[1]) continue;
        const Eigen::Vector2d corner(low_.x() + static_cast<double>(column) * size_.x(),
                                     low_.y() + static_cast<double>(row) * size_.y());
        if (visit(first[0], first[1], corner, Eigen::Vector2d(corner + size_))) return;
      }
    }
  }

 private:
  // Returns the column or row of a coordinate. It does not decrease if the coordinate grows, so the cells of
  // a box have every point of the box.
  std::size_t cell(double coordinate, int axis) const;

  Eigen::Vector2d low_, size_ = Eigen::Vector2d::Zero();
  double rounding_ = 0;
  std::size_t counts_[2] = {1, 1};  // columns and rows
  std::vector<Eigen::Vector2d> points_;
  std::vector<std::uint32_t> first_;  // the first point of each cell, and their number at the end
};

}  // namespace pcl_bv::detail
