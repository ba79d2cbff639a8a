// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A reference for chunk_supports(), which compares every point exactly.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "pcl_bv/kernels/support.h"

namespace pcl_bv::test {
using namespace detail;

inline ChunkSupports run(Isa isa, const PointView& points, const SupportDirections& set,
                         const SupportBounds& bounds = no_support_bounds()) {
  ChunkSupports supports;
  chunk_supports(isa, points, set, bounds, supports);
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
    for (std::size_t support = 0; support < 2 * set.count; ++support) {
      SupportPoint& best = out.supports[support];
      const int order = best.found ? compare_along(set.support_direction(support), p, best.point) : 1;
      if (order > 0 || (order == 0 && points.index(i) < best.index)) best = {true, p, points.index(i)};
    }
  }
  return out;
}

inline void expect_same(const ChunkSupports& a, const ChunkSupports& b, std::size_t directions) {
  EXPECT_EQ(a.dropped, b.dropped);
  for (std::size_t support = 0; support < 2 * directions; ++support) {
    SCOPED_TRACE("support " + std::to_string(support));
    ASSERT_EQ(a.supports[support].found, b.supports[support].found);
    EXPECT_EQ(a.supports[support].index, b.supports[support].index);
  }
}

/// Expects that all supports are found if their own projections are the known bounds, and none if the bounds
/// are larger by 1.
inline void expect_found_unless_beyond(Isa isa, const PointView& points, const SupportDirections& set) {
  const ChunkSupports all = run(isa, points, set);
  SupportBounds same = no_support_bounds(), beyond = same;
  for (std::size_t support = 0; support < 2 * set.count; ++support) {
    same[support] = projection_lower_bound(set, support, all.supports[support].point);
    beyond[support] = same[support] + 1;
  }
  expect_same(run(isa, points, set, same), all, set.count);
  for (const SupportPoint& support : run(isa, points, set, beyond).supports)
    EXPECT_FALSE(support.found);
}

}  // namespace pcl_bv::test
