// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "planar_hull.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "rational.h"

namespace pcl_bv {
namespace {

using Eigen::Vector2d;
using test::Rational;

int exact_turn(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  const Rational left = (Rational(b.x()) - Rational(a.x())) * (Rational(c.y()) - Rational(a.y()));
  const Rational right = (Rational(b.y()) - Rational(a.y())) * (Rational(c.x()) - Rational(a.x()));
  return left > right ? 1 : left < right ? -1 : 0;
}

TEST(PlanarHull, TurnIsTheExactSignForPointsNearlyInARow) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const double size : {1e-100, 1e-3, 1.0, 1e3, 1e6, 1e90}) {
    for (int i = 0; i < 2000; ++i) {
      const double x = uniform(random), y = uniform(random), t = uniform(random);
      const Vector2d a(uniform(random) * size, uniform(random) * size), along(x * size, y * size);
      Vector2d b = a + along, c = a + t * along;
      for (std::uint64_t steps = random() % 4; steps > 0; --steps)
        c.y() = std::nextafter(c.y(), i % 2 == 0 ? 1e300 : -1e300);
      ASSERT_EQ(turn(a, b, c), exact_turn(a, b, c)) << "seed 1, size " << size << ", case " << i;
    }
  }
}

}  // namespace
}  // namespace pcl_bv
