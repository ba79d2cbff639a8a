// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The search for extremes as the parts of a pass over chunks, so that other work can ride on the same pass.
#pragma once

#include <cstddef>

#include "pcl_bv/fitting/extremes.h"
#include "pcl_bv/kernels/extremes.h"
#include "shared_reach.h"

namespace pcl_bv {

/// Throws std::invalid_argument if the execution has extremes, but not those of these points. For every fit,
/// also where it does not use them.
void require_own_extremes(const PointView& points, const Execution& execution);

/// What one thread needs for the search, about; it decides whether threads are worth starting.
double search_seconds(Isa isa, DirectionSet set, std::size_t points);

/// Finds the extreme points of chunks of a cloud. May be used by several threads at a time: each profits from
/// what the others are known to reach. Which chunk sees what depends on timing; merged, the result does not.
class ExtremeSearch {
 public:
  /// `points` is the size of the whole cloud: a single chunk has nobody to tell.
  ExtremeSearch(UsableIsa isa, DirectionSet set, std::size_t points);

  /// Needs a FloatEnvironment.
  ChunkExtremes operator()(const PointView& chunk);

 private:
  UsableIsa isa_;
  DirectionSet set_;
  bool shared_;
  SharedReach<kMaxEnds> reach_;
};

/// Lets the points of `extremes` compete with those of a chunk.
void merge_extremes(const ChunkExtremes& part, Extremes& extremes);

/// From all chunks' points to the numbers; `points` is how many were searched.
void finish_extremes(std::size_t points, Extremes& extremes);

}  // namespace pcl_bv
