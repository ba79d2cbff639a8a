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
  /// Returns a number that is the same for the same lowest points in any order.
  std::uint64_t check_sum() const;

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
  /// Computes the surface of a cloud from its lowest points.
  SlopeSurface(LowestPoints lowest, const Execution& execution);
  ~SlopeSurface();
  SlopeSurface(SlopeSurface&&) noexcept;
  SlopeSurface& operator=(SlopeSurface&&) noexcept;

  /// Number of valid points; LowestPoints::valid_points().
  std::size_t valid_points() const;

  /// Number of cells with points.
  std::size_t cell_count() const;

  /// Sets ground[i] to 1 for each point of the view that is ground, otherwise to 0. The points must be in
  /// memory and must be points of the cloud. Points that are not valid are not ground.
  void classify(const PointView& points, std::uint8_t* ground) const;

 private:
  std::unique_ptr<LowestPoints::State> state_;
};

}  // namespace detail
}  // namespace pcl_bv
