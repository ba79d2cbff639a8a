// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Items in an order in which neighbours in space are mostly neighbours in the row.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pcl_bv/numeric/coordinates.h"
#include "pcl_bv/parallel/policy.h"

namespace pcl_bv {

/// Coordinates of items, an array for each axis. All valid.
template <typename T>
struct ItemPlaces {
  std::array<const T*, 3> axis;
  std::size_t count;
};

struct PlaceBounds {
  Coordinates low, high;
};

/// Sorts places by the cells of a cube of 1024^3 that they are in, in the order of Hilbert's curve (Skilling 2004),
/// and those of a crowded cell by the cells of a cube around them, and so on. Of equal places the first one first.
/// The same order for every policy. About 10 ns an item.
class SpatialOrder {
 public:
  template <typename T>
  void sort(const ItemPlaces<T>& places, const PlaceBounds& bounds, const ParallelPolicy& policy);

  std::size_t size() const { return count_; }
  /// Number of the item at a place in the order.
  std::uint32_t operator[](std::size_t place) const { return static_cast<std::uint32_t>(keyed_[place]); }

 private:
  std::vector<std::uint64_t> keyed_, buffer_;  // key, number
  std::size_t count_ = 0;
};

}  // namespace pcl_bv
