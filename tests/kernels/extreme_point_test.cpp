// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/kernels/extreme_point.h"

#include <gtest/gtest.h>

#include <limits>

#include "clouds.h"
#include "exact.h"

namespace pcl_bv {
namespace {

using test::Rational;

constexpr RoundedFilter kEverything{{0, 0, 0}, -std::numeric_limits<double>::infinity()};

TEST(ExtremePoint, IsTheExactlyGreatestWithTheSmallestIndex) {
  for (const auto& cloud : test::nasty_clouds<float>()) {
    if (cloud.size() > 2000) continue;  // rationals are slow
    for (const auto& d : kCubeDirections) {
      const std::array<int, 3> direction = {d[0], d[1], d[2]};
      ExtremePoint best;
      find_extreme_point(cloud.view(), 0, 1, cloud.size(), d, kEverything, best);
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

TEST(ExtremePoint, NamesTheCloudsIndexUnderAnIndexListAndBreaksTiesByIt) {
  const test::TestCloud<float> cloud{"ties", {5, 0, 0, 1, 1, 1, 9, 9, 9, 1, 1, 1, 1, 1, 1}};
  const std::int32_t indices[] = {4, 0, 3, 1};
  const PointView view = PointView::of(cloud.xyz.data(), 12, 4, indices);
  ExtremePoint best;
  find_extreme_point(view, 0, 1, 4, {0, 1, 1}, kEverything, best);
  EXPECT_EQ(best.index, 1U);
}

}  // namespace
}  // namespace pcl_bv
