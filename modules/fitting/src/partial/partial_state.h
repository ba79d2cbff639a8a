// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The data of a Partial.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <utility>

#include "moment_tree.h"
#include "partial/numbered_points.h"
#include "pcl_bv/fitting/partial.h"
#include "pcl_bv/kernels/support.h"
#include "pcl_bv/numeric/directions.h"
#include "pcl_bv/points/point_source.h"

namespace pcl_bv::detail {

/// The data of a Partial. The state depends on the points alone, not on how the points were divided into
/// parts or in which order the parts were merged.
struct PartialState {
  ScalarType scalar = ScalarType::float32;

  /// All points, if there are at most Partial::kMaxStored. Otherwise the points of the incomplete blocks. A
  /// block is incomplete if the Partial does not have all of its points.
  NumberedPoints loose;

  // The members below are set only if there are more than Partial::kMaxStored points.
  std::size_t used = 0;
  std::size_t dropped = 0;
  /// Support points in the order of SupportDirections, with their numbers in the whole cloud as indices.
  std::array<SupportPoint, 2 * kMaxDirections> support_points{};
  NumberedPoints extreme;  ///< The extreme points of all points, loose or not.
  MomentTree blocks;       ///< The moments of complete blocks.

  bool stores_all() const { return used + dropped == 0; }
  std::size_t size() const { return stores_all() ? loose.size() : used + dropped; }
};

inline std::size_t block_of_number(std::size_t number) {
  return number / kBlockPoints;
}

/// Converts a state that stores all points to the form for more than kMaxStored points.
PartialState reduced(PartialState state);

/// Returns the moments of all points of a state. The points of an incomplete block are treated as a block.
Moments moments_of_all(const PartialState& state);

struct PartialAccess {
  static const PartialState& state(const Partial& partial) { return *partial.state_; }
  static Partial partial(PartialState state) {
    Partial made;
    made.state_ = std::make_shared<PartialState>(std::move(state));
    return made;
  }
};

/// Throws std::invalid_argument if two nodes of `blocks` share a block, or if a loose point is in a node's
/// block.
void require_apart(const PartialState& state);

}  // namespace pcl_bv::detail
