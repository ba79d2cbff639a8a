// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Checks by exact rational arithmetic, on the stored numbers, whether a volume contains every point.
#pragma once

#include <cstddef>

#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/volumes/any_volume.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Result of verify().
struct Verification {
  std::size_t checked = 0;  ///< Number of valid points, all of which are checked.
  std::size_t outside = 0;  ///< Number of valid points that are outside by exact arithmetic.
  /// The largest distance of an outside point from the face or surface that it is beyond, in the points'
  /// unit. 0 if no point is outside. Infinity if the volume is empty and there is a valid point.
  double max_violation = 0;
};

/// Checks for every valid point whether it is inside the volume, by the exact predicates of the volume on the
/// stored numbers. A point that a double computation with a rigorous error bound proves inside is not checked
/// again. All other points are decided in rational arithmetic. O(n).
Verification verify(const AnyVolume& volume, const PointView& points, const Execution& execution = {});

}  // namespace pcl_bv
