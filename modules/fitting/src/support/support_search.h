// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The search for supports. SupportSearch::find() searches a single chunk, so that the same pass can do other
// work on the chunk.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <string_view>

#include "pcl_bv/fitting/fit_into.h"
#include "pcl_bv/fitting/supports.h"
#include "pcl_bv/kernels/axis_extents.h"
#include "pcl_bv/kernels/support.h"

namespace pcl_bv::detail {

/// Throws std::invalid_argument if the execution has supports of other points. Every fit calls this function,
/// even a fit that does not use the supports.
void require_matching_supports(const PointView& points, const FitExecution& execution);

/// Returns whether the points are a few points that represent a whole cloud (Supports::moments).
inline bool represents_cloud(const FitExecution& execution) {
  return execution.supports != nullptr && execution.supports->moments != nullptr;
}

/// Throws std::invalid_argument if represents_cloud(). Fits whose volume depends on all points call this
/// function. `fit` is the name of the fit in the message.
void require_all_points(const FitExecution& execution, const char* fit);

/// The name of a fit for require_all_points() and refuse_partial().
inline constexpr const char* kConcavePrism = "prism with a concave outline (concave_length)";

/// Throws the std::invalid_argument of require_all_points().
[[noreturn]] void refuse_partial(std::string_view fit);

/// Finds the support points of a cloud chunk by chunk.
class SupportSearch {
 public:
  /// `points` is the number of points of the cloud. Stores a reference to `directions`.
  SupportSearch(UsableIsa isa, const SupportDirections& directions, std::size_t points);

  /// Finds the support points of a chunk. Several threads may call find() at the same time. The calls share
  /// the largest projections found so far, and skip points with smaller projections. The points that a call
  /// finds depend on timing, but the merged result does not. Needs a FloatEnvironment.
  ChunkSupports find(const PointView& chunk);

  /// Merges the support points of a chunk into those found so far.
  void merge(const ChunkSupports& part);

  /// Calls find() and merge() for all chunks of the cloud.
  void run(const PointView& points, const FitExecution& execution);

  /// Number of points of the merged chunks that are not valid.
  std::size_t dropped() const { return all_.dropped; }

  /// Returns the support along the k-th direction; the cloud must have a valid point.
  Support along(std::size_t k) const;

 private:
  UsableIsa isa_;
  const SupportDirections& directions_;
  bool shared_;  // whether there are several chunks, which then share known_max_
  std::array<std::atomic<double>, kMaxSupports> known_max_;
  ChunkSupports all_;
};

/// Returns the support along the k-th direction. `low` and `high` are the points with the minimum and the
/// maximum projection.
Support support_between(const SupportDirections& directions, std::size_t k, const SupportPoint& low,
                        const SupportPoint& high);

/// Returns the supports that a search along the directions of `set` has found for all points of a view, of
/// which `dropped` are not valid. The rank is not set.
Supports supports_of_search(const SupportSearch& search, DirectionSet set, const PointView& points,
                            std::size_t dropped);

/// These functions compute the supports of the axis-aligned box chunk by chunk. empty_bounds() returns the
/// start value, merge_bounds() adds the box of a chunk, and finish_bounds() sets the number of valid points.
Supports empty_bounds(const PointView& points);
void merge_bounds(const AxisExtents& part, Supports& supports);
void finish_bounds(Supports& supports);

}  // namespace pcl_bv::detail
