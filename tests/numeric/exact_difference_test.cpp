// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/numeric/exact_difference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "exact.h"

namespace pcl_bv::detail {
namespace {

using test::Rational;

TEST(ExactDifference, IsToldFromARoundedOneAsInRationalArithmetic) {
  std::mt19937_64 random(1);
  const auto number = [&] {  // with few or many digits, of like or unlike sizes
    const auto digits = static_cast<double>(random() >> (random() % 2 == 0 ? 11U : 56U));
    return std::ldexp(random() % 2 == 0 ? digits : -digits, static_cast<int>(random() % 80) - 40);
  };
  int exact = 0, rounded = 0;
  for (int i = 0; i < 20'000; ++i) {
    const double a = i % 50 == 0 ? 0 : i % 50 == 1 ? 1 : i % 50 == 2 ? -1 : number();
    const double b = i % 70 == 0 ? 0 : i % 50 < 3 && i % 3 > 0 ? std::ldexp(1, 50 + i % 8) : number();
    const double difference = b - a;
    const bool expected = Rational(b) - Rational(a) == Rational(difference);
    ASSERT_EQ(is_exact_difference(b, a, difference), expected) << "seed 1, " << b << " - " << a;
    (expected ? exact : rounded) += 1;
  }
  EXPECT_GT(exact, 2000);
  EXPECT_GT(rounded, 2000);
}

}  // namespace
}  // namespace pcl_bv::detail
