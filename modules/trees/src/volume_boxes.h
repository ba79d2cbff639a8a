// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What trees of volumes share: boxes of boxes around them, and the walk through them.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "box_levels.h"
#include "box_walk.h"
#include "pcl_bv/kernels/packed_tree.h"
#include "pcl_bv/volumes/any_volume.h"

namespace pcl_bv {

/// Volumes that a thread measures at a time: some 20 us.
inline constexpr std::size_t kVolumesOfChunk = 64;

/// What contains() of a volume in a box may add to it, in any direction, and more: each adds less than 2^-45
/// of the distance and the sizes to each of up to three distances that are at right angles.
double contained_margin(const Aabb& box);

/// A box around all that contains() of a volume may hold, and around aabb(). Of an empty volume low is above
/// high; of one that no box is known for (planes need not enclose anything), infinite.
PlaceBounds extent_of(const AnyVolume& volume);

/// Sides of a box as those of a BoxGroup are compared with.
struct BoxQuery {
  float low[3], high[3];
};

/// Boxes around volumes, by their numbers.
class VolumeBoxes {
 public:
  /// Chooses the order, too. O(n log n).
  void build(const std::vector<PlaceBounds>& extents, const ParallelPolicy& policy);

  /// Of the same number of volumes, which have moved: the order stays.
  void refit(const std::vector<PlaceBounds>& extents);

  const BoxLevels& levels() const { return boxes_; }
  std::size_t size() const { return order_.size(); }
  std::uint32_t number(std::size_t item) const { return order_[item]; }

  /// Those without a box, ascending.
  const std::vector<std::uint32_t>& everywhere() const { return everywhere_; }

  /// How far from its box, in the frame of the boxes, anything may be that an answer about a place or a ray
  /// from there depends on. Roundings of double are less than 2^-40 of the distance and the sizes, what they
  /// are multiplied with in flat ellipsoids and sharp hulls is below 2^20: the others are asked without a box
  /// (see volume_tree.cpp).
  static double slack(double place) { return 0x1p-20 * (1 + std::abs(place)); }

  double to_frame(double coordinate, std::size_t axis) const {
    return (coordinate - boxes_.origin[axis]) * boxes_.scale;
  }

  /// All that is between low and high, and what slack() says.
  BoxQuery query(const Coordinates& low, const Coordinates& high) const;

  /// Calls visit(number) for those without a box, then for those whose box overlaps; ends where it returns
  /// true.
  template <typename Visit>
  bool visit(const BoxQuery& query, const Visit& visit) const;

 private:
  BoxLevels boxes_;
  std::vector<std::uint32_t> order_;  // number of each item
  std::vector<std::uint32_t> everywhere_;
};

/// The boxes of a group that overlap a box, as bits.
inline std::uint32_t overlapping(const BoxGroup& group, const BoxQuery& query) {
  // Products of 0 and 1 instead of branches: so the compiler makes vectors of it.
  alignas(64) std::uint32_t out[kTreeWidth];
  for (std::size_t k = 0; k < kTreeWidth; ++k) {
    const float x = std::max(group.low[0][k] - query.high[0], query.low[0] - group.high[0][k]);
    const float y = std::max(group.low[1][k] - query.high[1], query.low[1] - group.high[1][k]);
    const float z = std::max(group.low[2][k] - query.high[2], query.low[2] - group.high[2][k]);
    out[k] = std::max(std::max(x, y), z) <= 0 ? 1U : 0U;
  }
  std::uint32_t bits = 0;
  for (std::size_t k = 0; k < kTreeWidth; ++k)
    bits |= out[k] << k;
  return bits;
}

template <typename Visit>
bool VolumeBoxes::visit(const BoxQuery& query, const Visit& visit) const {
  for (const std::uint32_t number : everywhere_) {
    if (visit(number)) return true;
  }
  return walk(
      boxes_, [&](std::size_t group) { return overlapping(boxes_.groups[group], query); },
      [&](std::size_t item) { return visit(order_[item]); });
}

}  // namespace pcl_bv
