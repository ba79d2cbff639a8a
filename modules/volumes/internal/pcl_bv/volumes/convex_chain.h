// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The convex polygon of points whose order and orientation are given by functions, so that the points need
// not be pairs of doubles.
#pragma once

#include <cstddef>
#include <vector>

namespace pcl_bv::detail {

/// Returns the numbers of the corners of the convex hull, counter-clockwise, beginning with point 0. The
/// points 0 to count - 1 must be different and in ascending lexicographic order. turn(i, j, k) is the sign of
/// the orientation of three points. O(count). Andrew 1979.
template <typename Turn>
std::vector<std::size_t> convex_chain(std::size_t count, const Turn& turn) {
  std::vector<std::size_t> chain;
  // Appends a point to the chain that begins at position `first`. Before that, removes corners from the end
  // of this chain until the chain turns left at its last corner.
  const auto extend = [&](std::size_t next, std::size_t first) {
    while (chain.size() >= first + 2 && turn(chain[chain.size() - 2], chain.back(), next) <= 0)
      chain.pop_back();
    chain.push_back(next);
  };
  for (std::size_t i = 0; i < count; ++i)
    extend(i, 0);
  if (count < 3) return chain;
  const std::size_t lower = chain.size() - 1;
  for (std::size_t i = count - 1; i-- > 0;)
    extend(i, lower);
  chain.pop_back();  // the first corner, which was appended a second time
  return chain;
}

}  // namespace pcl_bv::detail
