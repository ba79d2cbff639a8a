// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "box/bernstein.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <random>

namespace pcl_bv::detail {
namespace {

// The value of a polynomial in Bernstein form, by its definition.
template <std::size_t n>
double value(const std::array<double, n>& coefficients, double t) {
  double sum = 0, binomial = 1;
  for (std::size_t i = 0; i < n; ++i) {
    const auto k = static_cast<double>(i), rest = static_cast<double>(n - 1 - i);
    sum += binomial * std::pow(t, k) * std::pow(1 - t, rest) * coefficients[i];
    binomial *= rest / (k + 1);
  }
  return sum;
}

TEST(Bernstein, ValueOfAProductIsTheProductOfTheValues) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto linear = [&] { return Linear{uniform(random), uniform(random)}; };
  for (int i = 0; i < 100; ++i) {
    const Linear a = linear(), b = linear();
    const Quadratic p = product(a, b), q = product(linear(), linear());
    const Quartic r = product(p, q);
    for (const double t : {0.0, 0.1, 0.5, 0.8, 1.0}) {
      EXPECT_NEAR(value(p, t), value(a, t) * value(b, t), 1e-14) << "seed 1, " << i << ", " << t;
      EXPECT_NEAR(value_at(r, t), value(r, t), 1e-14) << "seed 1, " << i << ", " << t;
      EXPECT_NEAR(value(r, t), value(p, t) * value(q, t), 1e-14) << "seed 1, " << i << ", " << t;
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail
