// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What a fit says of itself, beside the volume.
#pragma once

#include <cstddef>
#include <cstdint>

namespace [[gnu::visibility("default")]] pcl_bv {

enum class EstimationStatus : std::uint8_t {
  ok,          ///< The volume has three dimensions.
  degenerate,  ///< The points lie in a plane, on a line or in one point of the volume's directions: rank < 3.
  no_valid_points  ///< Nothing to enclose: the volume is empty.
};

/// `rank`: 3 minus the number of independent directions, among those that the volume looks along, in which
/// all points have one and the same coordinate. A tilted plane therefore has rank 3 for an axis-aligned box.
struct EstimationResult {
  EstimationStatus status = EstimationStatus::no_valid_points;
  int rank = 0;
  std::size_t used = 0;     ///< Points enclosed.
  std::size_t dropped = 0;  ///< Points with a coordinate that is not finite (double: or beyond 1e100).
};

}  // namespace pcl_bv
