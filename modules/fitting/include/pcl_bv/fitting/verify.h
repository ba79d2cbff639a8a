// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Checks by exact rational arithmetic, on the numbers as stored, whether a volume contains every point.
#pragma once

#include <cstddef>

#include "pcl_bv/fitting/execution.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/volumes/any_volume.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Result of verify().
struct Verification {
  std::size_t checked = 0;  ///< Number of valid points, all of which are checked.
  std::size_t outside = 0;  ///< Number of these points that are outside by exact arithmetic.
  /// The largest distance from an outside point to the face or surface that it is beyond, in the points'
  /// unit. 0 if no point is outside; infinity if the volume is empty and there is a valid point.
  double max_violation = 0;
};

/// Checks for every valid point whether it is inside the volume, by the exact predicates of the volume on the
/// numbers as stored. If a double computation with a rigorous error bound proves a point inside, it is not
/// computed again; all other points are decided in rational arithmetic. O(n).
Verification verify(const AnyVolume& volume, const PointView& points, const Execution& execution = {});

}  // namespace pcl_bv
