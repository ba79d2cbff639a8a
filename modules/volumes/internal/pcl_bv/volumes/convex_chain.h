// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The convex polygon of points whose order and orientation are given by functions, so that the points need
// not be pairs of doubles.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pcl_bv::detail {

/// Returns the corners of the convex hull of the numbered points in `order`, counter-clockwise, beginning
/// with the smallest. before(i, j) is the lexicographic order of the points, and must order equal points,
/// too. equal(i, j) is true for points at the same position, of which only the first remains. turn(i, j, k)
/// is the sign of the orientation of three points. O(n log n). Andrew 1979.
template <typename Before, typename Equal, typename Turn>
std::vector<std::size_t> convex_chain(std::vector<std::size_t> order, const Before& before,
                                      const Equal& equal, const Turn& turn) {
  std::sort(order.begin(), order.end(), before);
  order.erase(std::unique(order.begin(), order.end(), equal), order.end());
  if (order.size() < 3) return order;
  std::vector<std::size_t> chain;
  // Appends a point to the chain that begins at position `first`. Before that, removes corners from the end
  // of this chain until the chain turns left at its last corner.
  const auto extend = [&](std::size_t next, std::size_t first) {
    while (chain.size() >= first + 2 && turn(chain[chain.size() - 2], chain.back(), next) <= 0)
      chain.pop_back();
    chain.push_back(next);
  };
  for (const std::size_t i : order)
    extend(i, 0);
  const std::size_t lower = chain.size() - 1;
  for (std::size_t k = order.size() - 1; k-- > 0;)
    extend(order[k], lower);
  chain.pop_back();  // the first corner, which was appended a second time
  return chain;
}

}  // namespace pcl_bv::detail
