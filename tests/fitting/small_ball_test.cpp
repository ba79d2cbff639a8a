// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/fitting/small_ball.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace pcl_bv::detail {
namespace {

using Points = std::vector<Eigen::Vector3d>;

// The ball with all of the given points on its boundary and its centre in their affine hull.
bool circumball(const Points& support, SmallBall& ball) {
  const auto m = static_cast<Eigen::Index>(support.size()) - 1;
  Eigen::MatrixXd edges(3, m);
  for (Eigen::Index i = 0; i < m; ++i)
    edges.col(i) = support[static_cast<std::size_t>(i) + 1] - support[0];
  Eigen::VectorXd half(m);
  for (Eigen::Index i = 0; i < m; ++i)
    half(i) = edges.col(i).squaredNorm() / 2;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  if (m > 0) {
    const Eigen::MatrixXd gram = edges.transpose() * edges;
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(gram);
    if (lu.rank() < m) return false;
    offset = edges * lu.solve(half);
  }
  ball = {support[0] + offset, offset.squaredNorm()};
  return true;
}

// Tries every subset of at most four points.
double brute_force_squared_radius(const Points& points) {
  double best = std::numeric_limits<double>::infinity();
  const std::size_t n = points.size();
  for (std::size_t mask = 1; mask < (std::size_t{1} << n); ++mask) {
    Points support;
    for (std::size_t i = 0; i < n; ++i) {
      if ((mask >> i & 1) != 0) support.push_back(points[i]);
    }
    SmallBall ball;
    if (support.size() > 4 || !circumball(support, ball) || ball.squared_radius >= best) continue;
    bool holds_all = true;
    for (const auto& p : points) {
      holds_all = holds_all && (p - ball.center).squaredNorm() <= ball.squared_radius + 1e-12;
    }
    if (holds_all) best = ball.squared_radius;
  }
  return best;
}

double farthest(const Points& points, const Eigen::Vector3d& center) {
  double d2 = 0;
  for (const auto& p : points)
    d2 = std::max(d2, (p - center).squaredNorm());
  return d2;
}

void expect_smallest(Points points) {
  const double expected = brute_force_squared_radius(points);
  const Points original = points;
  const SmallBall ball = smallest_ball(points.data(), points.size());
  EXPECT_NEAR(ball.squared_radius, expected, 1e-12 * (1 + expected));
  EXPECT_LE(farthest(original, ball.center), expected + 1e-12 * (1 + expected));
}

TEST(SmallBall, FromABallOfNoPointsIsThatFromNone) {
  const Points points = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}};
  const SmallBall none = smallest_ball(points.data(), 0);
  const SmallBall ball = smallest_ball(points.data(), points.size(), &none);
  EXPECT_EQ(ball.center, Eigen::Vector3d(1, 0.5, 0));
  EXPECT_EQ(ball.squared_radius, 1.25);
  EXPECT_EQ(ball.support_size, 2);
}

TEST(SmallBall, EqualsTheBestOfAllSubsetsOnRandomPoints) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 300; ++i) {
    Points points(1 + random() % 9);
    for (auto& p : points)
      p = {uniform(random), uniform(random), uniform(random)};
    SCOPED_TRACE(testing::Message() << "case " << i << ", " << points.size() << " points");
    expect_smallest(points);
  }
}

TEST(SmallBall, EqualsTheBestOfAllSubsetsOnLatticePointsWithTheirTies) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 300; ++i) {
    Points points(1 + random() % 9);
    for (auto& p : points) {
      p = {static_cast<double>(random() % 3), static_cast<double>(random() % 3),
           i % 2 == 0 ? 0.0 : static_cast<double>(random() % 3)};
    }
    SCOPED_TRACE(testing::Message() << "case " << i << ", " << points.size() << " points");
    expect_smallest(points);
  }
}

TEST(SmallBall, OfNearlyRegularTetrahedraWithEdgesOfLengthOneAlongAnAxisTouchesAllFour) {
  // Whichever point comes first, some edge from it has a coordinate of 1 that elimination divides by.
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> small(-0.1, 0.1);
  for (int i = 0; i < 100; ++i) {
    Points points = {{0, 0, 0}, {1, small(random), 0.05}, {0, 1, small(random)}, {1, 1, 1}};
    std::shuffle(points.begin(), points.end(), random);
    points[0].z() += small(random);
    SCOPED_TRACE(testing::Message() << "seed 3, case " << i);
    expect_smallest(points);
  }
  for (int i = 0; i < 300; ++i) {
    Points points(4 + random() % 4);
    for (auto& p : points) {
      for (double& c : p)
        c = static_cast<double>(random() % 5) / 2;
    }
    SCOPED_TRACE(testing::Message() << "seed 3, halves " << i);
    expect_smallest(points);
  }
}

TEST(SmallBall, OfTheCubeCornersIsTheCircumscribedOne) {
  Points points;
  for (int i = 0; i < 8; ++i)
    points.emplace_back(i & 1, (i >> 1) & 1, (i >> 2) & 1);
  expect_smallest(points);
  EXPECT_NEAR(smallest_ball(points.data(), points.size()).squared_radius, 0.75, 1e-15);
}

TEST(SmallBall, OfPointsOnACircleOrALineIsFlatButRight) {
  Points circle, line;
  for (int i = 0; i < 12; ++i) {
    circle.emplace_back(std::cos(i), std::sin(i), 0);
    line.emplace_back(i, 2 * i, -i);
  }
  EXPECT_NEAR(smallest_ball(circle.data(), circle.size()).squared_radius, 1, 1e-12);
  EXPECT_NEAR(smallest_ball(line.data(), line.size()).squared_radius, 11 * 11 * 6 / 4.0, 1e-10);
}

TEST(SmallBall, OfOnePointOrEqualPointsHasRadiusZero) {
  Points one = {{1, 2, 3}};
  EXPECT_EQ(smallest_ball(one.data(), one.size()).squared_radius, 0);
  Points equal(20, {0.1, 0.2, 0.3});
  EXPECT_EQ(smallest_ball(equal.data(), equal.size()).squared_radius, 0);
  EXPECT_EQ(smallest_ball(equal.data(), equal.size()).center, Eigen::Vector3d(0.1, 0.2, 0.3));
}

// Weights of a support prove that nothing is smaller; on these sets solvers with a tolerance give up or err.
TEST(SmallBall, AgreesWithItsLowerBoundOnNearlyDegenerateSets) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (const double noise : {0.0, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15}) {
    for (int kind = 0; kind < 4; ++kind) {
      for (int i = 0; i < 200; ++i) {
        Points points(2 + random() % 30);
        for (auto& p : points) {
          const Eigen::Vector3d x(normal(random), normal(random), normal(random));
          if (kind == 0) p = x.normalized() + noise * x;
          if (kind == 1) p = Eigen::Vector3d(x.x(), x.y(), 0).normalized() + noise * x;
          if (kind == 2) p = Eigen::Vector3d(1, 2, 3) * x.x() + noise * x;
          if (kind == 3)
            p = Eigen::Vector3d(static_cast<double>(random() % 2), 0, static_cast<double>(random() % 3)) +
                noise * x;
        }
        const Eigen::Vector3d origin = points[0];
        for (auto& p : points)
          p -= origin;
        const SmallBall ball = smallest_ball(points.data(), points.size());
        SCOPED_TRACE(testing::Message() << "kind " << kind << ", noise " << noise << ", case " << i);
        EXPECT_LE(ball.squared_radius, ball.squared_lower_bound * (1 + 1e-14) + 1e-300);
        EXPECT_GE(ball.squared_radius, ball.squared_lower_bound * (1 - 1e-14));
        EXPECT_LE(farthest(points, ball.center), ball.squared_radius * (1 + 1e-15));
      }
    }
  }
}

TEST(SmallBall, StartsFromABallOfSomeOfThePoints) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  Points points(40);
  for (auto& p : points)
    p = {normal(random), normal(random), normal(random)};
  const SmallBall start = smallest_ball(points.data(), 20);
  const SmallBall all = smallest_ball(points.data(), 40);
  EXPECT_NEAR(smallest_ball(points.data(), 40, &start).squared_radius, all.squared_radius, 1e-14);
}

TEST(SmallBall, OfNoPointIsEmpty) {
  Points none;
  EXPECT_LT(smallest_ball(none.data(), none.size()).squared_radius, 0);
  EXPECT_EQ(smallest_ball(none.data(), none.size()).squared_lower_bound, 0);
}

// Walking solvers stop for ever on this one: three points almost on a line, one beside them.
TEST(SmallBall, EndsOnNearlyCollinearPoints) {
  for (const double e : {1e-3, 1e-8, 1e-12, 1e-15, 1e-17, 0.0}) {
    Points points = {{0, 0, 0}, {1, e, 0}, {0.5, 0, e}, {0.25, -e, e}, {1, 0, 0}};
    const Points original = points;
    const SmallBall ball = smallest_ball(points.data(), points.size());
    EXPECT_LE(farthest(original, ball.center), 0.25 + 2 * e + 1e-12) << e;
    EXPECT_GE(ball.squared_radius, 0.25 - 1e-12) << e;
  }
}

}  // namespace
}  // namespace pcl_bv::detail
