// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/numeric/exact_sum.h"

#include <gtest/gtest.h>

#include <random>

#include "exact.h"
#include "pcl_bv/numeric/directions.h"

namespace pcl_bv::detail {
namespace {

using test::Rational;

// Coordinates whose sums round: wide exponents, near cancellation, ties.
Coordinates awkward_point(std::mt19937_64& random) {
  const auto coordinate = [&random] {
    const int exponent = static_cast<int>(random() % 3 == 0 ? random() % 600 : random() % 60) - 30;
    const double mantissa = random() % 2 == 0 ? 1.0 : 1.0 + static_cast<double>(random() % 1024) * 0x1p-52;
    return (random() % 2 == 0 ? 1 : -1) * std::ldexp(mantissa, exponent % 300);
  };
  Coordinates p{coordinate(), coordinate(), coordinate()};
  if (random() % 3 == 0) p.y = -p.x * (1 + 0x1p-52);
  if (random() % 3 == 0) p.z = -(p.x + p.y);
  if (random() % 5 == 0) p.z = std::nextafter(p.z, 1e300);
  return p;
}

ExactSum exact_projection(const CubeDirection& d, const Coordinates& p) {
  return exact_sum(d[0] * p.x, d[1] * p.y, d[2] * p.z);
}

TEST(ExactSum, RoundsOutwardToTheNearestDoubleOnThatSide) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    const Coordinates p = awkward_point(random);
    const auto& d = kCubeDirections[random() % kMaxDirections];
    SCOPED_TRACE(testing::Message() << "case " << i << ": " << p.x << " " << p.y << " " << p.z);
    const Rational exact = test::exact_dot(std::array<int, 3>{d[0], d[1], d[2]}, p);
    const ExactSum sum = exact_projection(d, p);
    ASSERT_EQ(round_up(sum), test::least_double_above(exact));
    ASSERT_EQ(round_down(sum), test::greatest_double_below(exact));
  }
}

TEST(ExactSum, ComparesExactly) {
  std::mt19937_64 random(2);
  int equal = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto& d = kCubeDirections[random() % kMaxDirections];
    const Coordinates p = awkward_point(random);
    Coordinates q = random() % 2 == 0 ? awkward_point(random) : p;
    if (random() % 2 == 0) q = {q.x, std::nextafter(q.y, 1e300), std::nextafter(q.z, -1e300)};
    SCOPED_TRACE(testing::Message() << "case " << i);
    const std::array<int, 3> direction = {d[0], d[1], d[2]};
    const int expected = test::exact_dot(direction, p).compare(test::exact_dot(direction, q));
    ASSERT_EQ(compare(exact_projection(d, p), exact_projection(d, q)), (expected > 0) - (expected < 0));
    equal += expected == 0 ? 1 : 0;
  }
  EXPECT_GT(equal, 100) << "the cases must include ties";
}

TEST(ExactSum, SeesWhatDoublesLose) {
  const ExactSum sum = exact_sum(1e20, 1, -1e20);
  EXPECT_EQ(round_down(sum), 1.0);
  EXPECT_EQ(round_up(sum), 1.0);
}

TEST(ExactSum, NeverReturnsNegativeZero) {
  const ExactSum sum = exact_sum(-0.0, -0.0, -0.0);
  EXPECT_FALSE(std::signbit(round_down(sum)));
  EXPECT_FALSE(std::signbit(round_up(sum)));
}

}  // namespace
}  // namespace pcl_bv::detail
