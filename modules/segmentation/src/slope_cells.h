// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The cells of a SlopeSurface: a sparse grid perpendicular to the up direction.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "block_index.h"
#include "pcl_bv/parallel/execution.h"

namespace pcl_bv::detail {

/// Position of a cell in the grid.
struct CellPosition {
  std::int32_t x, y;
};

/// A cell with points. Heights are along the up direction.
struct SlopeCell {
  CellPosition at;
  double height;         ///< Of the lowest point; after find_envelope() of the surface in the centre.
  float rise_x, rise_y;  ///< Rise of the surface from one side of the cell to the other.
};

/// The cells with points. A cell keeps its number.
class SlopeCells {
 public:
  SlopeCells() { index_.reset(0); }

  /// Lowers the height of a cell to `height`. Inserts the cell if it is new.
  void add(CellPosition at, double height) {
    const std::uint32_t number = index_.number(key_of(at));
    if (number == cells_.size()) {
      cells_.push_back({at, height, 0, 0});
    } else if (height < cells_[number].height) {
      cells_[number].height = height;
    }
  }

  /// Returns the number of a cell; nullopt if the cell has no points.
  std::optional<std::uint32_t> find(CellPosition at) const { return index_.find_number(key_of(at)); }

  /// Returns the number of the cell that is (dx, dy) cells away from `at`; nullopt if it has no points or is
  /// outside the grid.
  std::optional<std::uint32_t> neighbour(CellPosition at, int dx, int dy) const;

  std::size_t size() const { return cells_.size(); }
  SlopeCell& operator[](std::size_t number) { return cells_[number]; }
  const SlopeCell& operator[](std::size_t number) const { return cells_[number]; }

 private:
  static std::uint64_t key_of(CellPosition at) {
    return std::uint64_t{static_cast<std::uint32_t>(at.x)} << 32U | static_cast<std::uint32_t>(at.y);
  }

  BlockIndex<std::uint64_t> index_;
  std::vector<SlopeCell> cells_;
};

/// Cells at most kLinkedCells from each other can be linked, and a cell at most kFarFromOutlier from an
/// outlier is above it. A patch of at least kPatchCells linked cells is certainly no reflection. The
/// reflections of a road that were seen in recorded sweeps have up to 8 cells of 1 m.
inline constexpr int kLinkedCells = 3, kFarFromOutlier = 10, kPatchCells = 20;

/// Returns a 1 for each cell whose height is an outlier, as described at split_ground_by_slope(). A cell is
/// above another one if it is higher by more than rise * (distance in cells) + margin.
std::vector<std::uint8_t> low_outliers(const SlopeCells& cells, double rise, double margin,
                                       const ParallelPolicy& policy);

/// Replaces the height of each cell by the minimum, over all cells without an `outlier`, of the height of the
/// other cell + rise * distance. Distances are those of centres, in cells.
void find_envelope(const std::vector<std::uint8_t>& outlier, double rise, const ParallelPolicy& policy,
                   SlopeCells& cells);

/// Sets the rises of all cells. Along each axis it is the rise to the next cell or that from the previous
/// cell, whichever is less steep. It is 0 if they have different signs or one of both cells has no points.
void find_rises(const ParallelPolicy& policy, SlopeCells& cells);

}  // namespace pcl_bv::detail
