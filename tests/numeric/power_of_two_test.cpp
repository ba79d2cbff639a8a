// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/numeric/power_of_two.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace pcl_bv::detail {
namespace {

TEST(PowerOfTwo, ExponentsAndProductsAreThoseOfTheStandardLibrary) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 100000; ++i) {
    const auto x = std::bit_cast<double>(random());
    if (std::isnan(x)) continue;
    ASSERT_EQ(binary_exponent(x), std::ilogb(x)) << x;
    const int exponent = static_cast<int>(random() % 4400) - 2200;
    ASSERT_EQ(times_power_of_two(x, exponent), std::ldexp(x, exponent)) << x << " " << exponent;
  }
  for (const double x : {0.0, std::numeric_limits<double>::infinity(), 0x1p-1022, 0x1p-1074, 0x1.8p1023}) {
    EXPECT_EQ(binary_exponent(x), std::ilogb(x)) << x;
    for (const int exponent : {-2100, -1075, -1023, -1022, 0, 1023, 1024, 2100})
      EXPECT_EQ(times_power_of_two(-x, exponent), std::ldexp(-x, exponent)) << x << " " << exponent;
  }
}

}  // namespace
}  // namespace pcl_bv::detail
