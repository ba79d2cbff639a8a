// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The generator against its published sequence, its distributions against their moments.
#include "pcl_bv/synth/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pcl_bv::detail {
namespace {

TEST(SplitMix64, GivesThePublishedSequence) {
  // The values for seed 1234567 that implementations of SplitMix64 are commonly checked with (Rosetta Code).
  SplitMix64 random(1234567);
  for (const std::uint64_t expected : {6457827717110365317u, 3203168211198807973u, 9817491932198370423u,
                                       4593380528125082431u, 16408922859458223821u}) {
    EXPECT_EQ(random.next(), expected);
  }
}

TEST(SplitMix64, KeysOneApartGiveUnrelatedStreams) {
  SplitMix64 a({1, 2, 3});
  SplitMix64 b({1, 2, 4});
  SplitMix64 c({1, 3, 2});
  a.next();  // streams that overlap would now run in step
  for (int i = 0; i < 100; ++i) {
    const std::uint64_t value = a.next();
    EXPECT_NE(value, b.next());
    EXPECT_NE(value, c.next());
  }
}

TEST(SplitMix64, UniformNumbersHaveTheMomentsOfUniform) {
  SplitMix64 random(7);
  constexpr int n = 1'000'000;
  double sum = 0;
  double squares = 0;
  double low = 1;
  double high = 0;
  for (int i = 0; i < n; ++i) {
    const double u = random.uniform();
    sum += u;
    squares += u * u;
    low = std::min(low, u);
    high = std::max(high, u);
  }
  // Five standard errors: sqrt(1/12/n) and sqrt(4/45/n).
  EXPECT_NEAR(sum / n, 0.5, 5 * 2.9e-4);
  EXPECT_NEAR(squares / n, 1.0 / 3, 5 * 3.0e-4);
  EXPECT_GE(low, 0);
  EXPECT_LT(low, 2e-5);
  EXPECT_LT(high, 1);
  EXPECT_GT(high, 1 - 2e-5);
}

TEST(SplitMix64, NormalNumbersHaveTheMomentsOfNormal) {
  SplitMix64 random(8);
  constexpr int n = 1'000'000;
  double moments[5] = {};
  int beyond_two = 0;
  for (int i = 0; i < n; ++i) {
    const double x = random.normal();
    for (int k = 1; k <= 4; ++k)
      moments[k] += std::pow(x, k) / n;
    beyond_two += std::abs(x) > 2;
  }
  // Five standard errors: sqrt(1/n), sqrt(2/n), sqrt(15/n), sqrt(96/n), and of a share of 4.55 %.
  EXPECT_NEAR(moments[1], 0, 5 * 1e-3);
  EXPECT_NEAR(moments[2], 1, 5 * 1.42e-3);
  EXPECT_NEAR(moments[3], 0, 5 * 3.9e-3);
  EXPECT_NEAR(moments[4], 3, 5 * 9.8e-3);
  EXPECT_NEAR(beyond_two / static_cast<double>(n), 0.0455003, 5 * 2.1e-4);
}

}  // namespace
}  // namespace pcl_bv::detail
