// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Ground removal by slope without the rest of the pipeline, for clouds that are not in memory.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "pcl_bv/nodes/pipeline_config.h"
#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/points/point_source.h"
#include "pcl_bv/segmentation/slope_surface.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Which points of a range are ground. All functions may be called by several threads at the same time.
class GroundBits {
 public:
  /// None of `count` points from number `first` on.
  GroundBits(std::size_t first, std::size_t count) : first_(first), words_((count + 63) / 64) {}

  /// Adds the points number first + i with ground[i] != 0.
  void add(std::size_t first, const std::vector<std::uint8_t>& ground);
  /// Returns the number of ground points.
  std::size_t count() const;
  /// Returns the bits, the first one in the lowest bit of the first word.
  std::vector<std::uint64_t> words() const { return {words_.begin(), words_.end()}; }

 private:
  std::size_t first_;
  std::vector<std::atomic<std::uint64_t>> words_;
};

/// Result of remove_slope_ground().
struct GroundView {
  PointView points;       ///< As many points as the input has; ground points are NaN.
  std::size_t valid = 0;  ///< Number of valid points of the input.
  std::shared_ptr<const PointSource> owner;  ///< Source of `points`.
};

/// Returns a view of `points` that removes the ground whenever points are loaded, with the same result as
/// split_ground_by_slope(). The input must outlive the view. Makes one pass over the points. Throws
/// std::invalid_argument if `points` has an index list.
GroundView remove_slope_ground(const PointView& points, const GroundConfig& config,
                               const Execution& execution);

/// Removes points of a surface that is known. GroundView::valid is not set. `bits` gets the ground points
/// when points are loaded, and must outlive the view, as `surface` must. Loading throws IoError for points
/// whose cells the surface lacks.
GroundView remove_slope_ground(const PointView& points, const SlopeSurface& surface, GroundBits& bits);

}  // namespace detail
}  // namespace pcl_bv
