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

/// The surface, defined in each cell with points. Const member functions may be called concurrently.
class SlopeSurface {
 public:
  /// Computes the surface in one pass over the points, which may be in memory or not. Depends neither on the
  /// order of the points nor on the execution. Takes up to 150 bytes for each cell with points;
  /// 115 were measured. Throws std::invalid_argument for an option outside its range.
  SlopeSurface(const PointView& points, const GroundSlopeOptions& options, const Execution& execution);
  ~SlopeSurface();
  SlopeSurface(SlopeSurface&&) noexcept;
  SlopeSurface& operator=(SlopeSurface&&) noexcept;

  /// Number of valid points.
  std::size_t valid_points() const;

  /// Number of cells with points.
  std::size_t cell_count() const;

  /// Sets ground[i] to 1 for each point of the view that is ground, otherwise to 0. The points must be in
  /// memory and must be points of the cloud. Points that are not valid are not ground.
  void classify(const PointView& points, std::uint8_t* ground) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace detail
}  // namespace pcl_bv
