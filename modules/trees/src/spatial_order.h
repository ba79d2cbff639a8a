// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Items in an order in which boxes around 16 in a row, and around 16 times as many, are small and apart.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "pcl_bv/numeric/coordinates.h"
#include "pcl_bv/parallel/policy.h"

namespace pcl_bv {

/// An item by a place that stands for it: valid. 16 bytes for float, 32 for double.
template <typename T>
struct PlacedItem {
  T place[3];
  std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t> number;
};

struct PlaceBounds {
  Coordinates low, high;
};

/// The least and the greatest coordinates of places, compared as T: floats faster than doubles. NaN is passed
/// over.
template <typename T>
struct Extremes {
  static constexpr T kMost = std::numeric_limits<T>::infinity();
  T low[3] = {kMost, kMost, kMost}, high[3] = {-kMost, -kMost, -kMost};

  void add(std::size_t axis, T value) {
    low[axis] = value < low[axis] ? value : low[axis];
    high[axis] = value > high[axis] ? value : high[axis];
  }
  /// -0 becomes 0: which of the two is kept would depend on the order of add().
  PlaceBounds bounds() const {
    return {{low[0] + 0.0, low[1] + 0.0, low[2] + 0.0}, {high[0] + 0.0, high[1] + 0.0, high[2] + 0.0}};
  }
};

/// Items in a row, where they are and where they go next; there are bins for as many.
template <typename T>
struct ItemRun {
  PlacedItem<T>* items = nullptr;
  PlacedItem<T>* other = nullptr;
  std::uint16_t* bins = nullptr;
  std::size_t count = 0;
  bool in_place = true;  ///< Whether `items`, not `other`, is where the order is to be.

  /// Of the items that went to `other`.
  ItemRun part(std::size_t begin, std::size_t end) const {
    return {other + begin, items + begin, bins + begin, end - begin, !in_place};
  }
};

/// Sorts items as the leaves of a balanced k-d tree (Bentley 1975) lie in a row: the longest side of the box
/// around the items is cut into up to four parts, so that each begins at a multiple of the greatest 16^k (k >
/// 0) that is less than their number, and each part likewise. Items with equal coordinates go by their
/// numbers. Runs of 16 or fewer, and of one place, are not cut: which items are in such a run follows from
/// the items alone, and their order inside it from the order before. Neither depends on the policy. O(n log
/// n): with less than 1000 a bin, a cut is a pass that counts and one that moves, and each divides runs by
/// four.
template <typename T>
class SpatialOrder {
 public:
  /// Room for `count` items, to be filled by the caller.
  PlacedItem<T>* reset(std::size_t count);

  /// Of the first `count` of them.
  void sort(std::size_t count, const ParallelPolicy& policy);

  const PlacedItem<T>& operator[](std::size_t place) const { return items_[place]; }

 private:
  void share_out(std::size_t runs, const ParallelPolicy& policy);

  std::vector<PlacedItem<T>> items_, buffer_;
  std::vector<std::uint16_t> bins_;
  std::vector<ItemRun<T>> runs_, parts_;  // for threads
};

}  // namespace pcl_bv
