// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A grid for finding boxes near a position.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <vector>

#include "pcl_bv/volumes/aabb.h"

namespace pcl_bv::detail {

/// A grid in x and y that finds boxes by their centres. A reused object keeps its capacity.
class BoxGrid {
 public:
  /// Replaces the content by these boxes, in square cells of `side` metres. O(n log n).
  void fill(const std::vector<Aabb>& boxes, double side) {
    side_ = side;
    cells_.clear();
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const Eigen::Vector3d center = boxes[i].center();
      cells_.push_back({square(center.x()), square(center.y()), i});
    }
    std::sort(cells_.begin(), cells_.end());
  }

  /// Calls visit(index) for all boxes whose centres are within one side length of a position in x and y. Also
  /// calls visit(index) for some boxes whose centres are at most two side lengths away.
  template <typename Visit>
  void visit_near(const Eigen::Vector3d& position, const Visit& visit) const {
    const double x = square(position.x()), y = square(position.y());
    // Above 2^53, adding 1 may not change a double. An offset that does not change `x` is skipped, so that no
    // box is visited twice.
    for (const double offset : {-1.0, 0.0, 1.0}) {
      const double column = x + offset;
      if (offset != 0 && column == x) continue;
      auto cell = std::lower_bound(cells_.begin(), cells_.end(), Cell{column, y - 1, 0});
      for (; cell != cells_.end() && cell->x == column && cell->y <= y + 1; ++cell)
        visit(cell->box);
    }
  }

 private:
  struct Cell {
    double x, y;
    std::size_t box;
    bool operator<(const Cell& other) const {
      return std::tie(x, y, box) < std::tie(other.x, other.y, other.box);
    }
  };

  double square(double coordinate) const { return std::floor(coordinate / side_); }

  double side_ = 1;
  std::vector<Cell> cells_;
};

}  // namespace pcl_bv::detail
