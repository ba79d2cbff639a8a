// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Sorts items so that boxes around each 16 consecutive items, each 256 items and so on are small and
// separate.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "pcl_bv/numeric/coordinates.h"
#include "pcl_bv/parallel/execution.h"

namespace pcl_bv::detail {

/// An item and a valid position that represents it. It takes 16 bytes for float and 32 bytes for double.
template <typename T>
struct PositionedItem {
  T position[3];
  std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t> index;
};

/// A box around positions; empty if low is above high.
struct PositionBounds {
  Coordinates low, high;
};

/// The smallest and the largest coordinates. They are compared as T, because floats are faster than doubles.
/// NaN is ignored.
template <typename T>
struct Extremes {
  static constexpr T kMost = std::numeric_limits<T>::infinity();
  T low[3] = {kMost, kMost, kMost}, high[3] = {-kMost, -kMost, -kMost};

  void add(std::size_t axis, T value) {
    low[axis] = value < low[axis] ? value : low[axis];
    high[axis] = value > high[axis] ? value : high[axis];
  }
  /// Returns the box. -0 becomes 0, because otherwise the sign of a zero would depend on the order of add()
  /// calls.
  PositionBounds bounds() const {
    return {{low[0] + 0.0, low[1] + 0.0, low[2] + 0.0}, {high[0] + 0.0, high[1] + 0.0, high[2] + 0.0}};
  }
};

/// A run of items, with the buffer of the items, the buffer to which the next cut moves them, and the bin of
/// each item.
template <typename T>
struct ItemRun {
  PositionedItem<T>* items = nullptr;
  PositionedItem<T>* other = nullptr;
  std::uint16_t* bins = nullptr;
  std::size_t count = 0;
  /// Whether the items must be in `items`, not in `other`, after the sort.
  bool in_place = true;

  /// Returns a part of the run after the items of the run have moved to `other`.
  ItemRun part(std::size_t begin, std::size_t end) const {
    return {other + begin, items + begin, bins + begin, end - begin, !in_place};
  }
};

/// Sorts items in the order of the leaves of a balanced k-d tree (Bentley 1975). O(n log n).
///
/// A run is cut along the longest side of the box around its items into up to four parts. Each part begins at
/// a multiple of the largest 16^k (k > 0) below the number of items. Each part is then cut in the same way.
/// Items with equal coordinates are ordered by index. A run of at most 16 items, or with all items at the
/// same position, is not cut.
///
/// The set of items in each run that is not cut depends only on the set of all items. The order of the items
/// within such a run also depends on their order before the sort. The set and the order do not depend on the
/// policy.
///
/// A cut takes three passes over a run. These passes find the longest side, count the items of each bin and
/// move the items. Then each bin that contains a cut position is partitioned. This is cheap for fewer than
/// 1000 items per bin.
template <typename T>
class SpatialOrder {
 public:
  /// Makes a buffer of `count` items and returns it. The caller must fill it.
  PositionedItem<T>* reset(std::size_t count);

  /// Sorts the first `count` items.
  void sort(std::size_t count, const ParallelPolicy& policy);

  /// Returns the item at a position of the sorted order.
  const PositionedItem<T>& operator[](std::size_t position) const { return items_[position]; }

 private:
  void split_for_threads(std::size_t runs, const ParallelPolicy& policy);

  std::vector<PositionedItem<T>> items_, buffer_;
  std::vector<std::uint16_t> bins_;
  std::vector<ItemRun<T>> runs_, parts_;  // runs that threads take
};

}  // namespace pcl_bv::detail
