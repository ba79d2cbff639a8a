// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/volumes/simple_polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>

#include "outlines.h"
#include "pcl_bv/volumes/planar_hull.h"

namespace pcl_bv::detail {
namespace {

using Eigen::Vector2d;
using testing::Polygon;

double doubled_area(const Polygon& corners) {
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2d a = corners[i] - corners[0], b = corners[(i + 1) % corners.size()] - corners[0];
    sum += a.x() * b.y() - a.y() * b.x();
  }
  return sum;
}

TEST(SimplePolygon, AcceptsPolygonsWhoseEdgesMeetAtSharedCornersOnly) {
  for (const Polygon& corners : testing::polygons(1, 300))
    EXPECT_TRUE(is_simple_polygon(corners)) << corners.size();
}

TEST(SimplePolygon, RefusesCrossedTouchingStraightAndClockwiseOnes) {
  for (const Polygon& wrong : {Polygon{{0, 0}, {2, 2}, {2, 0}, {0, 2}},          // crossed
                               Polygon{{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}},  // a corner on an edge
                               Polygon{{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}, {2, 1}},  // a corner twice
                               Polygon{{0, 0}, {2, 0}, {4, 0}, {2, 3}},                  // a straight corner
                               Polygon{{0, 0}, {4, 0}, {2, 0}, {2, 3}},                  // a spike
                               Polygon{{0, 0}, {0, 4}, {1, 4}, {1, 1}, {4, 1}, {4, 0}},  // clockwise
                               Polygon{{0, 0}, {1, 0}}})
    EXPECT_FALSE(is_simple_polygon(wrong)) << wrong.size() << " corners";
}

TEST(SimplePolygon, IsStrictlyConvexFromAnyFirstCorner) {
  EXPECT_TRUE(is_strictly_convex({{1, 1}, {0, 0}, {1, 0}}));
  EXPECT_TRUE(is_strictly_convex({{1, 1}, {0, 0}}));
  EXPECT_FALSE(is_strictly_convex({{1, 1}, {1, 0}, {0, 0}})) << "clockwise";
  EXPECT_FALSE(is_strictly_convex({{0, 0}, {1, 0}, {2, 0}, {1, 1}})) << "a straight corner";
  EXPECT_FALSE(is_strictly_convex(testing::l_shape()));
}

TEST(SimplePolygon, AGapOfOneRoundingStepIsAGap) {
  const double step = 0x1p-50;
  EXPECT_TRUE(is_simple_polygon({{0, 0}, {4, 0}, {4, 4}, {2, step}, {0, 4}}));
  EXPECT_FALSE(is_simple_polygon({{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}));
  EXPECT_FALSE(is_simple_polygon({{0, 0}, {4, 0}, {4, 4}, {2, -step}, {0, 4}}));
}

TEST(SimplePolygon, ContainsTheSamePointsAsInRationalArithmetic) {
  std::mt19937_64 random(2);
  for (const Polygon& corners : testing::polygons(2, 100)) {
    for (int i = 0; i < 60; ++i) {
      const Vector2d& a = corners[random() % corners.size()];
      const Vector2d& b = corners[random() % corners.size()];
      const Vector2d p = i % 3 == 0 ? a : i % 3 == 1 ? 0.5 * (a + b) : Vector2d(a.x(), b.y());
      EXPECT_EQ(polygon_contains(corners, p),
                testing::in_polygon(corners, testing::Rational(p.x()), testing::Rational(p.y())))
          << p.transpose();
    }
  }
}

TEST(SimplePolygon, TrianglesCoverItAndNothingElse) {
  for (const Polygon& corners : testing::polygons(3, 200)) {
    const auto triangles = triangles_of(corners);
    ASSERT_EQ(triangles.size(), corners.size() - 2);
    double sum = 0;
    for (const auto& [a, b, c] : triangles) {
      ASSERT_GT(orientation(corners[a], corners[b], corners[c]), 0);
      sum += doubled_area({corners[a], corners[b], corners[c]});
      const Vector2d middle = (corners[a] + corners[b] + corners[c]) / 3;
      EXPECT_TRUE(polygon_contains(corners, middle) || sum < 1e-9);
    }
    EXPECT_NEAR(sum, doubled_area(corners), 1e-6 * doubled_area(corners));
  }
}

TEST(SimplePolygon, WithoutStraightCornersIsTheSameSet) {
  const Polygon corners = {{0, 0}, {1, 0}, {3, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 2}, {1, 4}, {0, 4}};
  EXPECT_EQ(without_straight_corners(corners), testing::l_shape());
}

// Whether the polygon contains all sums of a point of `inner` and a point of the square. It does if it
// contains the corners' squares, and no edge of it meets the interior of an edge's strip. Sampled here.
TEST(PolygonAround, ContainsTheSquaresAroundAllPointsOfThePolygon) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const Polygon& inner : testing::polygons(4, 150)) {
    const double distance = inner[2].cwiseAbs().maxCoeff() * 0x1p-48;
    const auto outer = polygon_around(inner, distance);
    ASSERT_TRUE(outer) << inner.size();
    EXPECT_TRUE(is_simple_polygon(*outer));
    EXPECT_EQ(outer->size(), inner.size());
    for (std::size_t i = 0; i < inner.size(); ++i) {
      const double t = i % 2 == 0 ? 0 : uniform(random);
      const Vector2d p = inner[i] + t * (inner[(i + 1) % inner.size()] - inner[i]);
      for (const double x : {-distance, distance}) {
        for (const double y : {-distance, distance}) {
          const testing::Rational u = testing::Rational(p.x()) + testing::Rational(x),
                                  v = testing::Rational(p.y()) + testing::Rational(y);
          EXPECT_TRUE(testing::in_polygon(*outer, u, v)) << p.transpose();
        }
      }
    }
    EXPECT_NEAR(doubled_area(*outer), doubled_area(inner), 1e-3 * doubled_area(inner) + 1e-9);
  }
}

// Edges move by up to twice the size of the polygon. Some moved polygons are simple, but do not contain it.
TEST(PolygonAround, ContainsTheSquaresAroundAllPointsAtAnyDistanceOrIsNothing) {
  std::size_t given = 0, count = 0;
  for (const Polygon& inner : testing::polygons(5, 60)) {
    double size = 0;
    for (const Vector2d& corner : inner)
      size = std::max(size, (corner - inner[0]).cwiseAbs().maxCoeff());
    for (int k = 4; k < 40; ++k) {
      const double distance = size * std::exp2(-0.25 * k);
      const auto outer = polygon_around(inner, distance);
      ++count;
      if (!outer) continue;
      ++given;
      for (std::size_t i = 0; i < 8 * inner.size(); ++i) {
        const Vector2d &a = inner[i / 8], &b = inner[(i / 8 + 1) % inner.size()];
        const Vector2d p = a + static_cast<double>(i % 8) / 8 * (b - a);
        for (const double x : {-distance, distance}) {
          for (const double y : {-distance, distance}) {
            ASSERT_TRUE(polygon_contains(*outer, p + Vector2d(x, y)))
                << inner.size() << " corners, " << k << ", " << p.transpose();
          }
        }
      }
    }
  }
  EXPECT_GT(given, count / 2);
  EXPECT_LT(given, count);
}

TEST(PolygonAround, ReturnsNothingIfABayIsNarrowerThanTheDistance) {
  const Polygon bay = {{0, 0}, {4, 0}, {4, 4}, {2.125, 4}, {2, 1}, {1.875, 4}, {0, 4}};
  EXPECT_TRUE(polygon_around(bay, 0x1p-10));
  EXPECT_FALSE(polygon_around(bay, 0.25));
}

// The upper tooth's right side moves to above the lower tooth's right side. Only a horizontal line separates
// it from the strip of that side.
TEST(PolygonAround, MovesSidesThatOnlyAHorizontalLineSeparates) {
  const double d = 0x1p-6;
  const Polygon jaws = {{0, 0}, {5, 0}, {5, 1}, {3, 1},         {3, 2},         {2, 2}, {2, 1}, {1, 1},
                        {1, 4}, {2, 4}, {2, 3}, {3 - 4 * d, 3}, {3 - 4 * d, 4}, {5, 4}, {5, 5}, {0, 5}};
  ASSERT_TRUE(is_simple_polygon(jaws));
  EXPECT_TRUE(polygon_around(jaws, d));
}

TEST(PolygonAround, ReturnsNothingIfAnAngleIsBelowATenthOfADegree) {
  const Polygon wedge = {{0, 0}, {1000, 0}, {1000, 1}}, thin = {{0, 0}, {1000, 0}, {1000, 5}};
  EXPECT_FALSE(polygon_around(wedge, 0x1p-40));
  EXPECT_TRUE(polygon_around(thin, 0x1p-40));
}

TEST(PolygonAround, OfNoDistanceIsThePolygon) {
  EXPECT_EQ(polygon_around(testing::comb(), 0), testing::comb());
}

}  // namespace
}  // namespace pcl_bv::detail
