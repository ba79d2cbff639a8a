// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/volumes/planar_hull.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "rational.h"

namespace pcl_bv::detail {
namespace {

using Eigen::Vector2d;
using test::Rational;

int exact_orientation(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  const Rational left = (Rational(b.x()) - Rational(a.x())) * (Rational(c.y()) - Rational(a.y()));
  const Rational right = (Rational(b.y()) - Rational(a.y())) * (Rational(c.x()) - Rational(a.x()));
  return left > right ? 1 : left < right ? -1 : 0;
}

TEST(PlanarHull, KeepsNoCollinearPointAndNoDuplicate) {
  std::vector<Vector2d> points;
  for (int repeat = 0; repeat < 2; ++repeat) {
    for (int i = 0; i < 49; ++i)
      points.emplace_back(0.125 * (i % 7), 0.125 * (i / 7) + 0.375 * (i % 7));
  }
  const std::vector<std::size_t> corners = planar_hull(points);
  EXPECT_EQ(corners, (std::vector<std::size_t>{0, 6, 48, 42}));
  EXPECT_EQ(planar_hull({{1, 1}, {1, 1}, {1, 1}}), (std::vector<std::size_t>{0}));
  EXPECT_EQ(planar_hull({{1, 1}, {0, 0}, {2, 2}, {2, 2}}), (std::vector<std::size_t>{1, 2}));
}

TEST(PlanarHull, TurnsAreExactInAnyUnit) {
  // From lattices, whose points are often in a row, down to where products of differences vanish.
  std::mt19937_64 random(22);
  const auto coordinate = [&] { return static_cast<double>(random() % 9) - 4; };
  for (const int exponent : {0, 400, -400, -450, -500, -530, -560, -1072}) {
    for (int i = 0; i < 500; ++i) {
      Vector2d p[3];
      for (Vector2d& corner : p)
        corner = {std::ldexp(coordinate(), exponent), std::ldexp(coordinate(), exponent)};
      if (i % 2 == 0) p[i % 3].x() = std::nextafter(p[i % 3].x(), 1e300);
      ASSERT_EQ(orientation(p[0], p[1], p[2]), exact_orientation(p[0], p[1], p[2]))
          << "seed 22, unit 2^" << exponent << ", " << i;
    }
  }
}

TEST(PlanarHull, TurnsAreExact) {
  // 2^-60 above the line, which plain double cannot tell.
  EXPECT_EQ(orientation({0, 0}, {1, 1}, {0.5, 0.5}), 0);
  EXPECT_EQ(orientation({0x1p-60, 0}, {1, 1}, {0.5, 0.5}), 1);
  EXPECT_EQ(orientation({0, 0x1p-60}, {1, 1}, {0.5, 0.5}), -1);
}

TEST(PlanarHull, TurnsAreExactForPointsNearlyInARow) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const double size : {1e-100, 1e-3, 1.0, 1e3, 1e6, 1e90}) {
    for (int i = 0; i < 2000; ++i) {
      const double x = uniform(random), y = uniform(random), t = uniform(random);
      const Vector2d a(uniform(random) * size, uniform(random) * size), along(x * size, y * size);
      const Vector2d b = a + along;
      Vector2d c = a + t * along;
      for (std::uint64_t steps = random() % 4; steps > 0; --steps)
        c.y() = std::nextafter(c.y(), i % 2 == 0 ? 1e300 : -1e300);
      ASSERT_EQ(orientation(a, b, c), exact_orientation(a, b, c))
          << "seed 1, size " << size << ", case " << i;
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail
