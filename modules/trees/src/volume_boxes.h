// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Levels of boxes around volumes and their traversal, shared by all trees of volumes.
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

namespace pcl_bv::detail {

/// Number of volumes that a thread measures at a time, which takes about 20 us.
inline constexpr std::size_t kVolumesOfChunk = 64;

/// Returns an upper bound of the distance from a volume in `box` at which contains() may still accept a
/// point. Such a point is outside the volume in up to three perpendicular directions. In each of them, it is
/// outside by less than 2^-45 of the sum of its distance from the centre and the size of the volume.
double contains_margin(const Aabb& box);

/// Returns a box around aabb() and all points that contains() may accept. For an empty volume `low` is above
/// `high`. A side is infinite if a k-DOP or hull has no plane on this side that is perpendicular to the axis.
PositionBounds extent_of(const AnyVolume& volume);

/// A box of floats, in the frame of the boxes, to compare with a BoxGroup.
struct BoxQuery {
  float low[3], high[3];
};

/// Levels of boxes around volumes.
class VolumeBoxes {
 public:
  /// Chooses the order of the volumes and builds the boxes. O(n log n).
  void build(const std::vector<PositionBounds>& extents, const ParallelPolicy& policy);

  /// Rebuilds the boxes after the volumes have moved. The number of volumes must be the same. The order of
  /// the volumes does not change.
  void refit(const std::vector<PositionBounds>& extents);

  const BoxLevels& levels() const { return boxes_; }
  std::size_t size() const { return order_.size(); }
  /// Returns the index of the volume at position `item` of the order.
  std::uint32_t volume_index(std::size_t item) const { return order_[item]; }

  /// Returns the indices of the volumes without a box, ascending.
  const std::vector<std::uint32_t>& without_box() const { return without_box_; }

  /// Returns the margin by which queries at a coordinate x, in the frame of the boxes, extend the boxes. If a
  /// point or a ray misses the extended box of a volume, the volume cannot change the result. Rounding errors
  /// in double are below 2^-40 of the distance and the sizes. Flat ellipsoids and sharp hulls amplify these
  /// errors by less than 2^20. Ellipsoids that may amplify them more are tested for every ray (see
  /// is_too_flat_for_rays()).
  static double margin(double x) { return 0x1p-20 * (1 + std::abs(x)); }

  double to_frame(double coordinate, std::size_t axis) const {
    return (coordinate - boxes_.origin[axis]) * boxes_.scale;
  }

  /// Returns the box [low, high], extended by margin().
  BoxQuery query(const Coordinates& low, const Coordinates& high) const;

  /// Calls visit(index) for the volumes without a box, then for the volumes whose box overlaps the query.
  /// Stops and returns true when visit() returns true.
  template <typename Visit>
  bool visit(const BoxQuery& query, const Visit& visit) const;

 private:
  BoxLevels boxes_;
  std::vector<std::uint32_t> order_;  // index of the volume at each position
  std::vector<std::uint32_t> without_box_;
};

/// Returns a bit mask of the boxes of a group that overlap the query box.
inline std::uint32_t overlapping(const BoxGroup& group, const BoxQuery& query) {
  // Uses values 0 and 1 instead of branches, so that the compiler vectorises the loop.
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
  for (const std::uint32_t index : without_box_) {
    if (visit(index)) return true;
  }
  return walk(
      boxes_, [&](std::size_t group) { return overlapping(boxes_.groups[group], query); },
      [&](std::size_t item) { return visit(order_[item]); });
}

}  // namespace pcl_bv::detail
