// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The internals behind upright and minimal boxes, against slow judges.

#include "box/rectangle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "pcl_bv/volumes/planar_hull.h"

namespace pcl_bv::detail {
namespace {

using Points = std::vector<Eigen::Vector2d>;

// Random, on few grid lines (many collinear and equal), on a circle, on a line, all equal.
std::vector<Points> planar_clouds() {
  std::vector<Points> clouds;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::uniform_int_distribution<int> grid(0, 4);
  for (const int n : {1, 2, 3, 4, 5, 9, 40, 300}) {
    for (int repeat = 0; repeat < 12; ++repeat) {
      Points gauss, lattice, circle, line, same;
      for (int i = 0; i < n; ++i) {
        gauss.emplace_back(normal(random), normal(random));
        lattice.emplace_back(grid(random), grid(random));
        circle.emplace_back(std::cos(i), std::sin(i));
        line.emplace_back(3 * grid(random) - 2, 6 * grid(random) - 7);
        line.back().y() = 2 * line.back().x();
        same.emplace_back(0.5, -2);
      }
      clouds.insert(clouds.end(), {gauss, lattice, circle, line, same});
    }
  }
  return clouds;
}

TEST(Rectangle, ChainIsTheHullCounterClockwise) {
  for (const Points& cloud : planar_clouds()) {
    Points points = cloud;
    points.resize(to_convex_chain(points.data(), points.size()));
    Points hull;
    for (const std::size_t i : planar_hull(cloud))
      hull.push_back(cloud[i]);
    ASSERT_EQ(points.size(), hull.size()) << cloud.size() << " points";
    const auto first = std::find(points.begin(), points.end(), hull.front());
    ASSERT_NE(first, points.end());
    std::rotate(points.begin(), first, points.end());
    EXPECT_EQ(points, hull);
  }
}

double area_along(const Points& points, double angle) {
  const Eigen::Vector2d u(std::cos(angle), std::sin(angle)), v(-u.y(), u.x());
  double area = 1;
  for (const Eigen::Vector2d& n : {u, v}) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Eigen::Vector2d& p : points) {
      low = std::min(low, n.dot(p));
      high = std::max(high, n.dot(p));
    }
    area *= high - low;
  }
  return area;
}

TEST(Rectangle, NoAngleGivesLessAreaThanTheCalipers) {
  for (const Points& cloud : planar_clouds()) {
    Points points = cloud;
    const Rectangle box = smallest_rectangle(points.data(), to_convex_chain(points.data(), points.size()));
    EXPECT_NEAR(box.side.norm(), 1, 1e-15);
    const double of_side = area_along(cloud, std::atan2(box.side.y(), box.side.x()));
    EXPECT_NEAR(box.area(), of_side, 1e-12);
    for (int i = 0; i < 360; ++i)
      EXPECT_GE(area_along(cloud, i * 0.25 * 3.14159265358979 / 180), box.area() - 1e-12);
  }
}

TEST(Rectangle, OfALineIsAlongIt) {
  Points line{{1, 2}, {3, 6}, {-2, -4}, {0, 0}};
  const Rectangle box = smallest_rectangle(line.data(), to_convex_chain(line.data(), line.size()));
  EXPECT_EQ(box.area(), 0);
  EXPECT_NEAR(std::abs(box.side.dot(Eigen::Vector2d(1, 2).normalized())), 1, 1e-15);
  EXPECT_NEAR(box.diagonal(), std::sqrt(125.0), 1e-14);
}

TEST(Rectangle, OfOnePointHasNoSize) {
  const Eigen::Vector2d point(3, -4);
  const Rectangle box = smallest_rectangle(&point, 1);
  EXPECT_EQ(box.side, Eigen::Vector2d::UnitX());
  EXPECT_EQ(box.width, 0);
  EXPECT_EQ(box.height, 0);
}

}  // namespace
}  // namespace pcl_bv::detail
