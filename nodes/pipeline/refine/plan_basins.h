// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Peaks of the density of points in a plane, and the points around each peak.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Splits points of a plane into basins, one around each peak of their density. The method is clustering by
/// persistence (Chazal et al. 2013). Two peaks are one basin if the density on the best path between them
/// nowhere falls below half the density of the lower peak.
///
/// The density of a square cell is a weighted sum of the numbers of points in the 5 x 5 cells around it. The
/// weights are whole numbers, so the result does not depend on the order of the points.
class PlanBasins {
 public:
  /// Replaces `basin_of` by the number of each point's basin. Returns the number of basins. Basin 0 has the
  /// densest peak. `side` is the side of a cell, above 0. If the points span more than 2^22 cells, all of
  /// them are one basin. O(n log n). A reused object allocates only if it needs more memory than before.
  std::size_t find(const std::vector<Eigen::Vector2d>& points, double side,
                   std::vector<std::uint32_t>& basin_of);

  /// Allocates the memory for find() of at most `points` points in a rectangle with these sides.
  void reserve(std::size_t points, const Eigen::Vector2d& sides, double side);

 private:
  struct Cell {
    std::uint64_t density = 0;
    std::uint32_t place = 0;  // in the grid
    // Denser cells are first. Cells of equal density are sorted by their place, so the result does not depend
    // on the order of the points.
    bool operator<(const Cell& other) const {
      return density != other.density ? density > other.density : place < other.place;
    }
  };

  bool make_grid(const Eigen::Vector2d& sides, double side);
  void fill_cells(const std::vector<Eigen::Vector2d>& points, double side);
  void sort_by_density();
  void join_cells();
  std::uint32_t peak_of(std::uint32_t cell);
  void join(std::uint32_t a, std::uint32_t b, std::uint64_t saddle);

  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();  // lower corner of the points
  std::size_t stride_ = 0;                         // cells of a column of the grid
  std::vector<std::uint32_t> count_;   // number of points at each place of the grid; 0 between two calls
  std::vector<std::uint32_t> number_;  // number of the cell at each place; kNone between two calls
  std::vector<Cell> cells_;            // in the order of descending density
  std::vector<std::uint32_t> parent_;  // for each cell, a cell of the same basin; itself for the peak
  std::vector<std::uint32_t> place_of_;  // of each point
  std::vector<std::uint32_t> basin_;     // of each cell
};

}  // namespace detail
}  // namespace pcl_bv
