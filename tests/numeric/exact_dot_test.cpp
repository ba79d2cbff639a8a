// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/numeric/exact_dot.h"

#include <gtest/gtest.h>

#include <random>

#include "exact.h"

namespace pcl_bv::detail {
namespace {

using test::Rational;

// Numbers of every size and shape: a few bits or all, near one another or hundreds of orders apart, denormal.
class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : random_(seed) {}

  std::uint64_t below(std::uint64_t n) { return random_() % n; }

  double any(int least_exponent, int greatest_exponent) {
    const int spread = below(2) == 0 ? 4 : greatest_exponent - least_exponent;
    const int exponent = least_exponent + static_cast<int>(below(static_cast<std::uint64_t>(spread) + 1));
    const double mantissa = below(2) == 0
                                ? 1.0 + static_cast<double>(below(4)) / 4
                                : 1.0 + static_cast<double>(below(std::uint64_t{1} << 52)) * 0x1p-52;
    if (below(12) == 0) return 0.0;
    return std::ldexp(below(2) == 0 ? mantissa : -mantissa, exponent);
  }

  Direction direction() {
    const int least = below(4) == 0 ? -1074 : below(2) == 0 ? -100 : -2;
    return {any(least, 99), any(least, 99), any(least, 99)};
  }
  Coordinates point() {
    const int least = below(4) == 0 ? -1074 : below(2) == 0 ? -149 : -10;
    const int greatest = below(4) == 0 ? 332 : least == -149 ? 127 : 10;
    return {any(least, greatest), any(least, greatest), any(least, greatest)};
  }

 private:
  std::mt19937_64 random_;
};

TEST(ExactDot, RoundsOutwardToTheNearestDoubleOnThatSide) {
  Numbers numbers(1);
  for (int i = 0; i < 20000; ++i) {
    const Direction n = numbers.direction();
    Coordinates p = numbers.point();
    if (numbers.below(3) == 0) p.y = n[1] == 0 ? p.y : -(n[0] * p.x) / n[1];  // nearly cancels
    if (!is_valid(p)) continue;
    SCOPED_TRACE(testing::Message() << "case " << i << ": " << n[0] << ' ' << n[1] << ' ' << n[2] << " times "
                                    << p.x << ' ' << p.y << ' ' << p.z);
    const Rational exact = test::exact_dot(n, p);
    ASSERT_EQ(project_up(n, p), test::least_double_above(exact));
    ASSERT_EQ(project_down(n, p), test::greatest_double_below(exact));
  }
}

TEST(ExactDot, ComparesExactly) {
  Numbers numbers(2);
  int equal = 0, near = 0;
  for (int i = 0; i < 40000; ++i) {
    const Direction n = numbers.direction();
    const Coordinates p = numbers.point();
    Coordinates q = numbers.below(3) == 0 ? numbers.point() : p;
    if (numbers.below(3) == 0) q = {p.y, p.x, p.z};
    if (numbers.below(2) == 0) q.z = std::nextafter(q.z, 1e300);
    if (numbers.below(3) == 0) q.y = std::nextafter(q.y, -1e300);
    if (!is_valid(q)) continue;
    SCOPED_TRACE(testing::Message() << "case " << i);
    const Rational a = test::exact_dot(n, p), b = test::exact_dot(n, q);
    const int expected = a < b ? -1 : a > b ? 1 : 0;
    ASSERT_EQ(compare_along(n, p, q), expected);
    ASSERT_EQ(compare_along(n, q, p), -expected);
    equal += expected == 0 ? 1 : 0;
    const auto rounded = [&n](const Coordinates& r) { return (n[0] * r.x + n[1] * r.y) + n[2] * r.z; };
    near += expected != 0 && rounded(p) == rounded(q) ? 1 : 0;
  }
  EXPECT_GT(equal, 1000) << "the cases must include ties";
  EXPECT_GT(near, 1000) << "and what doubles cannot tell apart";
}

TEST(ExactDot, SeesProductsBelowTheSmallestDouble) {
  const Direction n = {1, 1e-300, 0};
  EXPECT_EQ(compare_along(n, {1, 1e-300, 0}, {1, 0, 0}), 1);
  EXPECT_EQ(compare_along(n, {1, 1e-300, 0}, {1, 2e-300, 0}), -1);
  EXPECT_EQ(project_up(n, {1, 1e-300, 0}), std::nextafter(1.0, 2.0));
  EXPECT_EQ(project_down(n, {1, 1e-300, 0}), 1.0);
  EXPECT_EQ(project_up(n, {0, -1e-300, 0}), 0.0);
  EXPECT_EQ(project_down(n, {0, -1e-300, 0}), -std::numeric_limits<double>::denorm_min());
}

TEST(ExactDot, HasRoomForEverySum) {
  // Three greatest products, all of a sign, at every distance from a least one.
  const double full = 0x1p53 - 1;
  for (int exponent = 0; exponent < 200; ++exponent) {
    for (const double sign : {1.0, -1.0}) {
      const double great = sign * std::ldexp(full, exponent - 100);
      for (const Direction& n :
           {Direction{great, great, great}, Direction{great, great, sign * full * 0x1p-100}}) {
        SCOPED_TRACE(testing::Message() << "exponent " << exponent);
        const Coordinates p{full, full, full};
        ASSERT_EQ(project_up(n, p), test::least_double_above(test::exact_dot(n, p)));
        ASSERT_EQ(project_down(n, p), test::greatest_double_below(test::exact_dot(n, p)));
      }
    }
  }
}

TEST(ExactDot, NeverReturnsNegativeZero) {
  for (const Coordinates& p :
       {Coordinates{-0.0, -0.0, -0.0}, Coordinates{1, -1, 0}, Coordinates{-1e-320, 0, 0}}) {
    EXPECT_FALSE(project_up({1e-10, 1e-10, 0}, p) == 0 && std::signbit(project_up({1e-10, 1e-10, 0}, p)));
    EXPECT_FALSE(std::signbit(project_down({1e-10, 1e-10, 0}, p)) && project_down({1e-10, 1e-10, 0}, p) == 0);
  }
}

}  // namespace
}  // namespace pcl_bv::detail
