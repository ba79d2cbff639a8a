// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/numeric/expansion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "pcl_bv/numeric/float_environment.h"
#include "rational.h"

namespace pcl_bv::detail {
namespace {

using test::Rational;

void expect_exact(const Expansion& sum, const Rational& exact) {
  EXPECT_EQ(sum.sign(), exact.sign());
  const double up = sum.up(), down = sum.down();
  EXPECT_GE(Rational(up), exact);
  EXPECT_LT(Rational(std::nextafter(up, -INFINITY)), exact);
  EXPECT_LE(Rational(down), exact);
  EXPECT_GT(Rational(std::nextafter(down, INFINITY)), exact);
}

// Spread over all exponents no term can be merged with another one.
TEST(Expansion, HoldsTermsOfEveryMagnitudeAtOnce) {
  const FloatEnvironment environment;
  for (const int step : {1, 3, 51, 52, 53, 54, 55, 60, 107}) {
    for (const double sign : {1.0, -1.0}) {
      Expansion sum;
      Rational exact = 0;
      for (int exponent = -1070; exponent <= 1000; exponent += step) {
        const double term = std::ldexp((exponent / step) % 2 == 0 ? 1.0 : sign, exponent);
        sum.add(term);
        exact += Rational(term);
      }
      SCOPED_TRACE(testing::Message() << "step " << step << ", sign " << sign);
      expect_exact(sum, exact);
    }
  }
}

TEST(Expansion, SumsRandomTermsExactly) {
  const FloatEnvironment environment;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> mantissa(-2, 2);
    const int range = seed % 2 == 0 ? 1000 : 60;
    std::uniform_int_distribution<int> exponent(-range, range);
    Expansion sum;
    Rational exact = 0;
    for (int i = 0; i < 300; ++i) {
      const double term = std::ldexp(mantissa(random), exponent(random));
      sum.add(term);
      exact += Rational(term);
    }
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    expect_exact(sum, exact);
    sum.add(-sum.value());
    EXPECT_LE(std::abs(sum.value()), std::ldexp(1.0, -50) * std::abs(static_cast<double>(exact)) + 1e-300);
  }
}

}  // namespace
}  // namespace pcl_bv::detail
