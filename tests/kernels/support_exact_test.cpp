// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/kernels/support.h"

#include <gtest/gtest.h>

#include "clouds.h"
#include "exact.h"

namespace pcl_bv::detail {
namespace {

using test::Rational;

TEST(SupportPoint, IsTheExactlyGreatestWithTheSmallestIndex) {
  for (const auto& cloud : test::nasty_clouds<float>()) {
    if (cloud.size() > 2000) continue;  // rationals are slow
    const SupportDirections& set = SupportDirections::of(DirectionSet::dop26);
    ChunkSupports supports;
    chunk_supports(Isa::automatic, cloud.view(), set, no_support_bounds(), supports);
    for (std::size_t support = 0; support < 2 * set.count; ++support) {
      const Direction direction = set.support_direction(support);
      const SupportPoint& best = supports.supports[support];
      bool found = false;
      Rational greatest;
      std::size_t index = 0;
      for (std::size_t i = 0; i < cloud.size(); ++i) {
        const Coordinates p = load_point(cloud.view(), i);
        if (!is_valid(p)) continue;
        const Rational projection = test::exact_dot(direction, p);
        if (found && projection <= greatest) continue;
        found = true;
        greatest = projection;
        index = i;
      }
      SCOPED_TRACE(cloud.name);
      ASSERT_EQ(best.found, found);
      if (found) {
        ASSERT_EQ(best.index, index);
      }
    }
  }
}

TEST(SupportPoint, NamesTheCloudsIndexUnderAnIndexListAndBreaksTiesByIt) {
  const test::TestCloud<float> cloud{"ties", {5, 0, 0, 1, 1, 1, 9, 9, 9, 1, 1, 1, 1, 1, 1}};
  const std::int32_t indices[] = {4, 0, 3, 1};
  const PointView view = PointView::of(cloud.xyz.data(), 12, 4, indices);
  const SupportDirections& set = SupportDirections::of(DirectionSet::dop26);
  ChunkSupports supports;
  chunk_supports(Isa::automatic, view, set, no_support_bounds(), supports);
  EXPECT_EQ(supports.supports[2 * 11 + 1].index, 1U);  // (0, 1, 1)
}

}  // namespace
}  // namespace pcl_bv::detail
