// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The ground surface of split_ground_by_slope(), for clouds that need not be in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/segmentation/ground.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// The lowest point of a cell of the grid. Cells are numbered from the origin; the height is along the up
/// direction.
struct LowestPoint {
  std::int32_t x = 0, y = 0;
  double height = 0;
};

/// A rectangle of cells, of which the last ones belong to it, too.
struct CellRange {
  std::int32_t min_x = 0, min_y = 0, max_x = -1, max_y = -1;

  bool empty() const { return min_x > max_x || min_y > max_y; }
  bool contains(const LowestPoint& p) const {
    return p.x >= min_x && p.x <= max_x && p.y >= min_y && p.y <= max_y;
  }
  bool intersects(const CellRange& other) const;
  void merge(const CellRange& other);
  /// Returns the range with `cells` more on each side, at most the whole grid.
  CellRange inflated(double cells) const;
};

/// Number of cells around a range that `highest` of cells_that_matter() includes.
inline constexpr int kBoundMargin = 11;

/// Returns the range of all cells whose lowest points can change the surface in a range. `lowest` is at most
/// the height of the cells that the caller asks about; call it for each group of cells and merge the ranges.
/// `highest` is at least the height of each cell (LowestPoint) in range.inflated(kBoundMargin).
CellRange cells_that_matter(const CellRange& range, double lowest, double highest,
                            const GroundSlopeOptions& options);

/// The lowest points of all cells that have points, from which the surface is computed. Those of shares of a
/// cloud are added to each other.
class LowestPoints {
 public:
  /// Has no cells. Throws std::invalid_argument for an option outside its range.
  explicit LowestPoints(const GroundSlopeOptions& options);
  ~LowestPoints();
  LowestPoints(LowestPoints&&) noexcept;
  LowestPoints& operator=(LowestPoints&&) noexcept;

  /// Adds the valid points of a cloud, which may be in memory or not, in one pass.
  void add(const PointView& points, const ParallelPolicy& policy);
  /// Adds the lowest point of a cell.
  void add(const LowestPoint& point);

  /// Number of valid points of add(points).
  std::size_t valid_points() const;
  /// Number of cells.
  std::size_t size() const;
  /// Cells are in no particular order.
  LowestPoint operator[](std::size_t cell) const;

 private:
  friend class SlopeSurface;
  struct State;
  std::unique_ptr<State> state_;
};

/// The surface, defined in each cell with points. Const member functions may be called concurrently.
class SlopeSurface {
 public:
  /// Computes the surface in one pass over the points, which may be in memory or not. Depends neither on the
  /// order of the points nor on the execution. Takes up to 150 bytes for each cell with points;
  /// 115 were measured. Throws std::invalid_argument for an option outside its range.
  SlopeSurface(const PointView& points, const GroundSlopeOptions& options, const Execution& execution);
  /// Computes the surface of a cloud from its lowest points, or in a range from those of cells_that_matter().
  SlopeSurface(LowestPoints lowest, const Execution& execution);
  ~SlopeSurface();
  SlopeSurface(SlopeSurface&&) noexcept;
  SlopeSurface& operator=(SlopeSurface&&) noexcept;

  /// Number of valid points; LowestPoints::valid_points().
  std::size_t valid_points() const;

  /// Number of cells with points.
  std::size_t cell_count() const;

  /// Sets ground[i] to 1 for each point of the view that is ground, otherwise to 0. The points must be in
  /// memory and must be points of the cloud. Points that are not valid are not ground. Returns the number of
  /// valid points whose cells the surface lacks: they are no points of the cloud, and not ground.
  std::size_t classify(const PointView& points, std::uint8_t* ground) const;

 private:
  std::unique_ptr<LowestPoints::State> state_;
};

}  // namespace detail
}  // namespace pcl_bv
