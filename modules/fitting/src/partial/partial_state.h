// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <array>
#include <cstddef>

#include "moment_tree.h"
#include "partial/numbered_points.h"
#include "pcl_bv/fitting/partial.h"
#include "pcl_bv/kernels/support.h"
#include "pcl_bv/numeric/directions.h"
#include "pcl_bv/points/chunks.h"

namespace pcl_bv {

/// What a Partial holds. The same points give the same state, whatever way they came.
struct PartialState {
  ScalarType scalar = ScalarType::float32;

  /// All points, if there are at most Partial::kAllKept; else those of the cloud's blocks that are not here
  /// whole.
  NumberedPoints loose;

  // Of more than Partial::kAllKept points:
  std::size_t used = 0;
  std::size_t dropped = 0;
  std::array<SupportPoint, 2 * kMaxDirections>
      ends{};              ///< As SupportDirections has them; numbers of the cloud.
  NumberedPoints extreme;  ///< Those of all points, loose or not.
  MomentTree blocks;       ///< Of whole blocks.

  bool all_kept() const { return used + dropped == 0; }
  std::size_t size() const { return all_kept() ? loose.size() : used + dropped; }
};

inline std::size_t block_of_number(std::size_t number) {
  return number / kBlockPoints;
}

/// Throws std::invalid_argument if a point is in two blocks, or in one and loose.
void require_apart(const PartialState& state);

}  // namespace pcl_bv
