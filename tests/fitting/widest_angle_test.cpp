// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "prism/widest_angle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "pcl_bv/volumes/planar_hull.h"

namespace pcl_bv::detail {
namespace {

using Eigen::Vector2d;

double angle_at(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const Vector2d to_a = a - p, to_b = b - p;
  return std::atan2(to_a.x() * to_b.y() - to_a.y() * to_b.x(), to_a.dot(to_b));
}

/// The widest angle of all points to the left of the edge that are not corners; 0 without such a point.
double widest_of_all(const PlanarGrid& grid, const std::vector<char>& is_corner, const Vector2d& a,
                     const Vector2d& b) {
  double widest = 0;
  for (std::size_t i = 0; i < grid.points().size(); ++i) {
    const Vector2d& p = grid.points()[i];
    if (is_corner[i] == 0 && orientation(a, b, p) > 0) widest = std::max(widest, angle_at(p, a, b));
  }
  return widest;
}

TEST(WidestAngle, IsTheWidestOfAllPointsToTheLeftOfTheEdge) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int acute = 0, none = 0;
  for (int cloud = 0; cloud < 100; ++cloud) {
    std::vector<Vector2d> points;
    for (int i = 0; i < 400; ++i)
      points.emplace_back(uniform(random), uniform(random));
    const PlanarGrid grid(points);
    // With many corners few points are left, so that the best one is often far from the edge.
    std::vector<char> is_corner(grid.points().size());
    for (char& corner : is_corner)
      corner = random() % 100 < 97 ? 1 : 0;
    for (int edge = 0; edge < 100; ++edge) {
      const Vector2d& a = points[random() % points.size()];
      const Vector2d b = a + 0.2 * Vector2d(uniform(random), uniform(random));
      const double widest = widest_of_all(grid, is_corner, a, b);
      const std::optional<std::uint32_t> found = widest_angle(grid, is_corner, a, b);
      ASSERT_EQ(found.has_value(), widest > 0) << "seed 1, cloud " << cloud << ", edge " << edge;
      acute += widest > 0 && widest < 1.5 ? 1 : 0;
      none += widest > 0 ? 0 : 1;
      if (!found) continue;
      ASSERT_EQ(is_corner[*found], 0);
      ASSERT_NEAR(angle_at(grid.points()[*found], a, b), widest, 1e-9)
          << "seed 1, cloud " << cloud << ", edge " << edge;
    }
  }
  EXPECT_GT(acute, 5000);
  EXPECT_GT(none, 50);
}

}  // namespace
}  // namespace pcl_bv::detail
