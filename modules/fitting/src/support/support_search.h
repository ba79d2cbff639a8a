// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The search for supports as the parts of a pass over chunks, so that other work can ride on the same pass.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <string_view>

#include "pcl_bv/fitting/supports.h"
#include "pcl_bv/kernels/axis_extents.h"
#include "pcl_bv/kernels/support.h"

namespace pcl_bv {

/// Throws std::invalid_argument if the execution has supports, but not those of these points. For every fit,
/// also where it does not use them.
void require_own_supports(const PointView& points, const Execution& execution);

/// Whether the points are few that stand for a cloud.
inline bool stand_for_all(const Execution& execution) {
  return execution.supports != nullptr && execution.supports->moments != nullptr;
}

/// Throws std::invalid_argument if they do, for a fit whose volume depends on all points.
void require_all_points(const Execution& execution, const char* fit);

[[noreturn]] void refuse_partial(std::string_view fit);

class SupportSearch {
 public:
  /// For a cloud of so many points. Keeps the directions.
  SupportSearch(UsableIsa isa, const SupportDirections& directions, std::size_t points);

  /// Of a chunk. Several threads may call it at a time, and each profits from what the others are known to
  /// reach. Which chunk sees what depends on timing; merged, the result does not. Needs a FloatEnvironment.
  ChunkSupports find(const PointView& chunk);

  /// Lets what was found so far compete with what a chunk has.
  void merge(const ChunkSupports& part);

  /// find() and merge() of all chunks of the cloud.
  void run(const PointView& points, const Execution& execution);

  /// Points of the merged chunks that are not valid.
  std::size_t dropped() const { return all_.dropped; }

  /// Along the k-th direction; of a cloud with a valid point.
  Support along(std::size_t k) const;

 private:
  UsableIsa isa_;
  const SupportDirections& directions_;
  bool shared_;  // a single chunk has nobody to tell
  std::array<std::atomic<double>, kMaxSupportEnds> reached_;
  ChunkSupports all_;
};

/// Along the k-th direction, for points that reach farthest at its two ends.
Support support_between(const SupportDirections& directions, std::size_t k, const SupportPoint& low,
                        const SupportPoint& high);

/// What a search along the directions of a set has found among all of these points, but for the rank.
Supports of_search(const SupportSearch& search, DirectionSet set, const PointView& points);

/// Lets a box, of no points at first, grow by that of a chunk.
Supports no_bounds(const PointView& points);
void merge_bounds(const AxisExtents& part, Supports& supports);
void finish_bounds(Supports& supports);

}  // namespace pcl_bv
