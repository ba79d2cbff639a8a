// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <optional>

#include "pcl_bv/parallel/policy.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/volumes/aabb.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// What a cloud is like, for those who have to choose a range, a tolerance or a reader.
struct CloudStatistics {
  Aabb box;  ///< Of the finite points that are not exactly at 0,0,0; empty if there is none.
  std::optional<double> spacing;  ///< Typical distance from a point to the nearest other one.
  std::size_t nonfinite = 0;      ///< Points with a coordinate that is not finite.
  std::size_t zero = 0;           ///< Points exactly at 0,0,0: dead beams, most likely.
};

/// Looks at every point, three times. Box and spacing are of the valid points that are no dead beams. The
/// spacing is the median, over up to 1000 of them evenly taken, of the exact distance to the nearest other
/// one; there is none of fewer than two. O(n) where spacings do not differ by much.
CloudStatistics cloud_statistics(const PointView& points, const ParallelPolicy& policy = Serial{});

}  // namespace pcl_bv
