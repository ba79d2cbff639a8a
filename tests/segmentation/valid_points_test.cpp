// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A larger box would only make the grid of cells larger, and clustering slower.
#include "valid_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace pcl_bv::detail {
namespace {

template <typename T>
class ValidPointsOf : public ::testing::Test {};
using ScalarTypes = ::testing::Types<float, double>;
TYPED_TEST_SUITE(ValidPointsOf, ScalarTypes);

TYPED_TEST(ValidPointsOf, HaveTheirSmallestBox) {
  using T = TypeParam;
  constexpr T nan = std::numeric_limits<T>::quiet_NaN();
  for (const T sign : {T(1), T(-1)}) {
    std::vector<std::array<T, 3>> cloud(20'000, {nan, sign, sign});
    cloud[7] = {sign * 2, sign * 30, sign * 400};
    cloud[15'000] = {sign * 5, sign * 20, sign * 300};
    const PointView view = PointView::of(cloud[0].data(), sizeof cloud[0], cloud.size());
    for (const ParallelPolicy& policy : {ParallelPolicy(Serial{}), ParallelPolicy(Threads{3})}) {
      ValidPoints<T> valid;
      copy_valid_points(view, policy, valid);
      EXPECT_EQ(valid.numbers, (std::vector<std::int32_t>{7, 15'000}));
      const Point<T>&low = valid.box.min, &high = valid.box.max;
      EXPECT_EQ((std::array{low.x, low.y, low.z}),
                (std::array{std::min(sign * 2, sign * 5), std::min(sign * 20, sign * 30),
                            std::min(sign * 300, sign * 400)}));
      EXPECT_EQ((std::array{high.x, high.y, high.z}),
                (std::array{std::max(sign * 2, sign * 5), std::max(sign * 20, sign * 30),
                            std::max(sign * 300, sign * 400)}));
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail
