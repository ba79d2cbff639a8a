// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Sorts items so that boxes around 16 consecutive items, and around 16 times as many, are small and separate.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "pcl_bv/numeric/coordinates.h"
#include "pcl_bv/parallel/policy.h"

namespace pcl_bv {

/// An item with the position that represents it, which must be valid. 16 bytes for float, 32 for double.
template <typename T>
struct PositionedItem {
  T position[3];
  std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t> index;
};

/// A box around positions; empty if low is above high.
struct PositionBounds {
  Coordinates low, high;
};

/// The smallest and the largest coordinates, compared as T: floats are faster than doubles. NaN is ignored.
template <typename T>
struct Extremes {
  static constexpr T kMost = std::numeric_limits<T>::infinity();
  T low[3] = {kMost, kMost, kMost}, high[3] = {-kMost, -kMost, -kMost};

  void add(std::size_t axis, T value) {
    low[axis] = value < low[axis] ? value : low[axis];
    high[axis] = value > high[axis] ? value : high[axis];
  }
  /// Returns the box. -0 becomes 0, as otherwise the sign of a zero would depend on the order of add().
  PositionBounds bounds() const {
    return {{low[0] + 0.0, low[1] + 0.0, low[2] + 0.0}, {high[0] + 0.0, high[1] + 0.0, high[2] + 0.0}};
  }
};

/// A run of items: their buffer, the buffer that the next cut moves them to, and a bin for each item.
template <typename T>
struct ItemRun {
  PositionedItem<T>* items = nullptr;
  PositionedItem<T>* other = nullptr;
  std::uint16_t* bins = nullptr;
  std::size_t count = 0;
  /// Whether the sorted items belong to the buffer `items`, not `other`.
  bool in_place = true;

  /// Returns a part of the run after its items have moved to `other`.
  ItemRun part(std::size_t begin, std::size_t end) const {
    return {other + begin, items + begin, bins + begin, end - begin, !in_place};
  }
};

/// Sorts items in the order of the leaves of a balanced k-d tree (Bentley 1975). O(n log n).
///
/// The longest side of the box around the items is cut into up to four parts. Each part begins at a multiple
/// of the largest 16^k (k > 0) below the number of items. The parts are cut likewise. Items with equal
/// coordinates are ordered by index. Runs of at most 16 items, or with all items at one position, are not
/// cut. Which items are in such a run depends on the items only, and their order within it on the order
/// before; neither depends on the policy. With fewer than 1000 items a bin, a cut is one pass that counts and
/// one that moves, and divides a run by four.
template <typename T>
class SpatialOrder {
 public:
  /// Makes a buffer of `count` items and returns it, to be filled by the caller.
  PositionedItem<T>* reset(std::size_t count);

  /// Sorts the first `count` items.
  void sort(std::size_t count, const ParallelPolicy& policy);

  /// Returns the item in a position of the sorted order.
  const PositionedItem<T>& operator[](std::size_t position) const { return items_[position]; }

 private:
  void split_for_threads(std::size_t runs, const ParallelPolicy& policy);

  std::vector<PositionedItem<T>> items_, buffer_;
  std::vector<std::uint16_t> bins_;
  std::vector<ItemRun<T>> runs_, parts_;  // runs that threads share
};

}  // namespace pcl_bv
