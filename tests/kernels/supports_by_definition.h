// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The judge of chunk_supports(): every point, exactly.
#pragma once

#include <gtest/gtest.h>

#include "pcl_bv/kernels/support.h"

namespace pcl_bv::test {

inline ChunkSupports run(Isa isa, const PointView& points, const SupportDirections& set,
                         const SupportBounds& reached = no_support_bounds()) {
  ChunkSupports supports;
  chunk_supports(isa, points, set, reached, supports);
  return supports;
}

inline ChunkSupports by_definition(const PointView& points, const SupportDirections& set) {
  ChunkSupports out;
  for (std::size_t i = 0; i < points.count; ++i) {
    const Coordinates p = load_point(points, i);
    if (!is_valid(p)) {
      ++out.dropped;
      continue;
    }
    for (std::size_t end = 0; end < 2 * set.count; ++end) {
      SupportPoint& best = out.supports[end];
      const int order = best.found ? compare_along(set.support_direction(end), p, best.point) : 1;
      if (order > 0 || (order == 0 && points.index(i) < best.index)) best = {true, p, points.index(i)};
    }
  }
  return out;
}

inline void expect_same(const ChunkSupports& a, const ChunkSupports& b, std::size_t directions) {
  EXPECT_EQ(a.dropped, b.dropped);
  for (std::size_t end = 0; end < 2 * directions; ++end) {
    SCOPED_TRACE("end " + std::to_string(end));
    ASSERT_EQ(a.supports[end].found, b.supports[end].found);
    EXPECT_EQ(a.supports[end].index, b.supports[end].index);
  }
}

/// What the support points are known to reach leaves them to be found; a little more, and none is.
inline void expect_found_unless_beyond(Isa isa, const PointView& points, const SupportDirections& set) {
  const ChunkSupports all = run(isa, points, set);
  SupportBounds same = no_support_bounds(), beyond = same;
  for (std::size_t end = 0; end < 2 * set.count; ++end) {
    same[end] = projection_lower_bound(set, end, all.supports[end].point);
    beyond[end] = same[end] + 1;
  }
  expect_same(run(isa, points, set, same), all, set.count);
  for (const SupportPoint& end : run(isa, points, set, beyond).supports)
    EXPECT_FALSE(end.found);
}

}  // namespace pcl_bv::test
