// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The proof: does a volume hold every point, by exact rational arithmetic on the numbers as stored?
#pragma once

#include <cstddef>

#include "pcl_bv/fitting/execution.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/volumes/any_volume.h"

namespace [[gnu::visibility("default")]] pcl_bv {

struct Verification {
  std::size_t checked = 0;  ///< Finite points looked at.
  std::size_t outside = 0;  ///< Of them, those outside by exact arithmetic.
  double worst = 0;         ///< The greatest distance past a face or surface, in the points' unit; 0 if none.
};

/// Checks the exact predicates of the volume, in the numbers as stored, for every finite point. Points that a
/// double computation with a rigorous error bound already places inside are not computed again; all others
/// are decided in rationals.
Verification verify(const AnyVolume& volume, const PointView& points, const Execution& execution = {});

}  // namespace pcl_bv
