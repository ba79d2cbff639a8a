// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/numeric/directed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "exact.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/expansion.h"

namespace pcl_bv::detail {
namespace {

using test::Rational;

constexpr int kSeed = 1, kCases = 5000;

// Of any sign, with many digits or few, between 2^least and 2^greatest.
class Numbers {
 public:
  double operator()(int least, int greatest) {
    const auto mantissa = static_cast<double>(random_() >> (random_() % 2 == 0 ? 11 : 60));
    const int exponent = least + static_cast<int>(random_() % static_cast<unsigned>(greatest - least));
    return std::ldexp(random_() % 2 == 0 ? mantissa : -mantissa, exponent);
  }

 private:
  std::mt19937_64 random_{kSeed};
};

TEST(Directed, NextUpAndDownAreTheNeighbours) {
  constexpr double least = std::numeric_limits<double>::denorm_min(),
                   most = std::numeric_limits<double>::max();
  EXPECT_EQ(next_up(1), 1 + 0x1p-52);
  EXPECT_EQ(next_down(1), 1 - 0x1p-53);
  EXPECT_EQ(next_up(0), least);
  EXPECT_EQ(next_down(0), -least);
  EXPECT_EQ(next_up(most), kInfinity);
  EXPECT_EQ(next_down(kInfinity), most);
}

TEST(Directed, SumsAndProductsAreTheLeastDoublesAbove) {
  Numbers number;
  for (int i = 0; i < kCases; ++i) {
    const double a = number(-100, 100), b = number(-100, 100);
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", case " << i << ": " << a << ", " << b);
    ASSERT_EQ(add_up(a, b), test::least_double_above(Rational(a) + Rational(b)));
    ASSERT_EQ(multiply_up(a, b), test::least_double_above(Rational(a) * Rational(b)));
  }
}

TEST(Directed, RootsAreTheLeastDoublesAbove) {
  Numbers number;
  for (int i = 0; i < kCases; ++i) {
    const double a = std::abs(number(-100, 100));
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", case " << i << ": " << a);
    ASSERT_EQ(sqrt_up(a), test::least_root_above(Rational(a), std::sqrt(a)));
  }
}

TEST(Directed, RootsOfNumbersDownToTheSmallestDenormalAreTheLeastDoublesAbove) {
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> mantissa(1, 2);
  for (int i = 0; i < kCases; ++i) {
    const double a = std::ldexp(mantissa(random), -1074 + i % 300);
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", case " << i << ": " << a);
    ASSERT_EQ(sqrt_up(a), test::least_root_above(Rational(a), std::sqrt(a)));
  }
}

TEST(Directed, QuotientsByPowersOfTwoRoundOutwardAmongDenormals) {
  Numbers number;
  int inexact = 0;
  for (int i = 0; i < kCases; ++i) {
    const double a = number(-300, 0), scale = std::ldexp(1, i % 1020);
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", case " << i << ": " << a << " / " << scale);
    const Rational exact = Rational(a) / Rational(scale);
    ASSERT_EQ(divide_up(a, scale), test::least_double_above(exact));
    ASSERT_EQ(divide_down(a, scale), test::greatest_double_below(exact));
    inexact += divide_up(a, scale) != divide_down(a, scale) ? 1 : 0;
  }
  EXPECT_GT(inexact, 100);
}

TEST(Directed, FloatsAreTheNearestOnTheirSide) {
  Numbers number;
  for (int i = 0; i < kCases; ++i) {
    const double x = number(-210, 70);  // from below the least denormal float
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", case " << i << ": " << x);
    const float up = float_up(x), down = float_down(x);
    ASSERT_GE(static_cast<double>(up), x);
    ASSERT_LE(static_cast<double>(down), x);
    ASSERT_LT(static_cast<double>(std::nextafter(up, -INFINITY)), x);
    ASSERT_GT(static_cast<double>(std::nextafter(down, INFINITY)), x);
  }
  EXPECT_EQ(float_up(1e300), INFINITY);
  EXPECT_EQ(float_down(1e300), std::numeric_limits<float>::max());
}

TEST(Expansion, RoundsSumsOfProductsOutwardToTheNextDouble) {
  Numbers number;
  for (int i = 0; i < kCases; ++i) {
    Expansion sum;
    Rational exact = 0;
    for (int term = 0; term < 1 + i % 7; ++term) {
      const double a = number(-100, 100), b = number(-100, 100);
      sum.add_product(a, b).add(b).add(i % 3 == 0 ? -a * b : 0);
      exact += Rational(a) * Rational(b) + Rational(b) + Rational(i % 3 == 0 ? -a * b : 0.0);
    }
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", case " << i);
    ASSERT_EQ(sum.up(), test::least_double_above(exact));
    ASSERT_EQ(sum.down(), test::greatest_double_below(exact));
    ASSERT_EQ(sum.sign(), (exact > 0) - (exact < 0));
    ASSERT_TRUE(sum.is_lossless());
  }
}

TEST(Expansion, RoundsSumsThatAreNextToADouble) {
  for (int exponent = -54; exponent > -1000; exponent -= 7) {
    const double tiny = std::ldexp(1.0, exponent);
    SCOPED_TRACE(testing::Message() << "2^" << exponent);
    for (const double large : {0.0, 1e200}) {
      const Expansion above = Expansion().add(large).add(1).add(tiny).add(-large);
      EXPECT_EQ(above.up(), next_up(1));
      EXPECT_EQ(above.down(), 1);
      const Expansion below = Expansion().add(large).add(-tiny).add(1).add(-large);
      EXPECT_EQ(below.up(), 1);
      EXPECT_EQ(below.down(), next_down(1));
      EXPECT_EQ(Expansion(above).add(-1).sign(), 1);
      EXPECT_EQ(Expansion(below).add(-1).sign(), -1);
    }
    EXPECT_EQ(Expansion().add(tiny).add(1).add(-tiny).up(), 1);
  }
}

TEST(Expansion, HoldsAnyNumberOfTermsOfWhichFewAreLeft) {
  Numbers number;
  Expansion sum;
  Rational exact = 0;
  for (int i = 0; i < 100; ++i) {
    const double x = number(-100, 100);
    sum.add(x).add(0.25).add(-x);
    exact += Rational(0.25);
    ASSERT_EQ(sum.up(), test::least_double_above(exact)) << "seed " << kSeed << ", case " << i;
    ASSERT_EQ(sum.down(), test::greatest_double_below(exact));
  }
}

TEST(Expansion, IsUncertainAndAStepWiderWhereAProductMayBeLost) {
  Expansion sum;
  sum.add(1).add_product(0x1.8p-537, 0x1.8p-537);
  EXPECT_FALSE(sum.is_lossless());
  EXPECT_GT(sum.up(), 1);
  EXPECT_LE(sum.down(), 1);
  EXPECT_TRUE(Expansion().add_product(1, 0x1p-1074).is_lossless()) << "times 1 nothing is lost";
}

TEST(Expansion, IsNoStepWiderWhereWhatAProductLostCannotMatter) {
  const Expansion sum = Expansion().add(1).add(0x1p-60).add_product(0x1.8p-537, 0x1.8p-537);
  EXPECT_FALSE(sum.is_lossless());
  EXPECT_EQ(sum.up(), next_up(1));
  EXPECT_EQ(sum.down(), 1);
}

// Each of the small terms is less than half a step from the largest double, their sum is more.
TEST(Expansion, BoundsSumsBeyondTheLargestDoubleFromTheRightSide) {
  constexpr double largest = std::numeric_limits<double>::max();
  Expansion above, below;
  above.add(largest);
  below.add(-largest);
  for (int i = 0; i < 3; ++i) {
    above.add(0x1p969);
    below.add(-0x1p969);
  }
  EXPECT_EQ(above.up(), std::numeric_limits<double>::infinity());
  EXPECT_GE(below.up(), -largest);
  EXPECT_LE(above.down(), largest);
  EXPECT_EQ(below.down(), -std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace pcl_bv::detail
