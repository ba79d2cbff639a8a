// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Claims of prisms whose outline is not convex.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

#include "outlines.h"
#include "pcl_bv/volumes/any_volume.h"
#include "pcl_bv/volumes/obb.h"
#include "pcl_bv/volumes/outline.h"
#include "pcl_bv/volumes/pair_queries.h"
#include "pcl_bv/volumes/prism.h"
#include "pcl_bv/volumes/simple_polygon.h"
#include "round_volumes.h"

namespace pcl_bv::detail {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::Polygon;

const Eigen::Matrix3d kAxes = Eigen::Matrix3d::Identity();

Prism l_prism() {
  return {kAxes, testing::l_shape(), 1, 3};
}

TEST(ConcavePrism, OfAnLHasItsMeasures) {
  const Prism prism = l_prism();
  EXPECT_FALSE(prism.is_convex());
  EXPECT_DOUBLE_EQ(prism.footprint_area(), 7);
  EXPECT_DOUBLE_EQ(prism.volume(), 14);
  EXPECT_DOUBLE_EQ(prism.surface_area(), 2 * 7 + 16 * 2);
  EXPECT_EQ(prism.aabb(), Aabb({0, 0, 1}, {4, 4, 3}));
  EXPECT_EQ(prism.support({1, 1, 1}).head<2>().sum(), 5);
  EXPECT_EQ(prism.footprint().size(), 6U);
  EXPECT_TRUE(prism.contains({0.5, 3, 2}));
  EXPECT_TRUE(prism.contains({1, 1, 2})) << "the inner corner";
  EXPECT_TRUE(prism.contains({1, 3, 3})) << "on a side";
  EXPECT_FALSE(prism.contains({2, 2, 2})) << "in the bay";
  EXPECT_DOUBLE_EQ(prism.distance({2, 2, 2}), 1);
  EXPECT_DOUBLE_EQ(prism.distance({2.5, 3, 2}), 1.5);
  EXPECT_DOUBLE_EQ(prism.distance({0.5, 0.5, 5}), 2) << "above";
  EXPECT_DOUBLE_EQ(prism.distance({2, 2, 4}), std::sqrt(2));
  EXPECT_EQ(prism.distance({0.5, 3, 2}), 0);
  EXPECT_TRUE(prism.center().isApprox(Vector3d(19.0 / 14, 19.0 / 14, 2)));
}

TEST(ConcavePrism, EqualsItselfAndNotItsConvexHull) {
  EXPECT_EQ(l_prism(), l_prism());
  const Prism hull = convex_prism(l_prism());
  EXPECT_NE(hull, l_prism());
  EXPECT_TRUE(hull.is_convex());
  EXPECT_EQ(hull.outline().size(), 5U);
  EXPECT_EQ(convex_prism(hull), hull);
}

TEST(ConcavePrism, RefusesOutlinesThatCrossOrTouchThemselves) {
  for (const Polygon& wrong :
       {Polygon{{0, 0}, {2, 2}, {2, 0}, {0, 2}}, Polygon{{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}},
        Polygon{{0, 0}, {0, 4}, {1, 4}, {1, 1}, {4, 1}, {4, 0}}}) {
    try {
      Prism(kAxes, wrong, 0, 1);
      ADD_FAILURE() << wrong.size();
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find("edges meet only at"), std::string::npos) << error.what();
    }
  }
}

TEST(ConcavePrism, ContainsEveryPointOfItAndNoneFarOutside) {
  testing::Random random(5);
  int strays = 0;
  for (const Polygon& outline : testing::polygons(5, 120)) {
    const Eigen::Matrix3d axes =
        outline.size() % 2 == 0 ? kAxes : orthonormal_axes(random.isometry(1).linear());
    const Prism prism(axes, outline, -1, 1);
    const double size = (outline[0] - outline[1]).norm();
    for (std::size_t i = 0; i < 4 * outline.size(); ++i) {
      const Vector2d& a = outline[i % outline.size()];
      const Vector2d& b = outline[(i + 1 + i / outline.size()) % outline.size()];
      const double t = random.uniform(0, 1);
      const double off_edge = i % 2 == 0 ? 0 : 0.01 * size;
      const Vector2d at = a + t * (b - a) + off_edge * Vector2d(random.uniform(-1, 1), 0.5);
      const Vector3d p = axes.col(0) * at.x() + axes.col(1) * at.y();
      const bool inside = testing::in_polygon(outline, testing::dot(axes.col(0), testing::exact(p)),
                                              testing::dot(axes.col(1), testing::exact(p)));
      EXPECT_TRUE(prism.contains(p) || !inside) << i;
      EXPECT_EQ(prism.distance(p) == 0, prism.contains(p));
      if (off_edge == 0 || inside) continue;
      strays += prism.contains(p) ? 1 : 0;
    }
  }
  EXPECT_EQ(strays, 0);
}

TEST(ConcavePrism, IsTheUnionOfThePrismsOverItsTriangles) {
  testing::Random random(6);
  for (const Polygon& outline : testing::polygons(6, 60)) {
    const Prism prism(kAxes, outline, 0, 1);
    std::vector<Prism> parts;
    for (const auto& [a, b, c] : triangles_of(outline))
      parts.emplace_back(kAxes, Polygon{outline[a], outline[b], outline[c]}, 0, 1);
    const Aabb box = prism.aabb();
    for (int i = 0; i < 100; ++i) {
      const auto point = [&] {
        return Vector3d(random.uniform(box.min().x(), box.max().x()),
                        random.uniform(box.min().y(), box.max().y()), random.uniform(-0.2, 1.2));
      };
      const Vector3d p = point();
      double nearest = 1e300;
      for (const Prism& part : parts)
        nearest = std::min(nearest, part.distance(p));
      EXPECT_NEAR(prism.distance(p), nearest, 1e-9 + 1e-15 * box.max().norm());
      const Vector3d origin = point(), to = i % 10 == 0 ? Vector3d(0, 0, 1) : Vector3d(point() - origin);
      const auto found = prism.intersect(origin, to);
      double enter = 1e300, exit = -1e300;
      for (const Prism& part : parts) {
        const auto span = part.intersect(origin, to);
        if (!span) continue;
        enter = std::min(enter, span->enter);
        exit = std::max(exit, span->exit);
      }
      ASSERT_EQ(found.has_value(), enter <= exit) << i;
      if (!found) continue;
      const double rounding = 1e-6 * (1 + std::abs(exit));
      EXPECT_NEAR(found->enter, enter, rounding);
      EXPECT_NEAR(found->exit, exit, rounding);
    }
  }
}

TEST(ConcavePrism, RayIntervalSpansFirstEntryToLastExit) {
  const Prism prism(kAxes, testing::comb(), 0, 1);
  const auto hit = prism.intersect({-1, 4, 0.5}, {1, 0, 0});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->enter, 1, 1e-12);
  EXPECT_NEAR(hit->exit, 10, 1e-12);
  EXPECT_FALSE(l_prism().intersect({5, 2, 2}, {-1, 1, 0})) << "through the bay and past the tip";
  EXPECT_FALSE(l_prism().intersect({2, 2, 0}, {0, 0, 1})) << "up, in the bay";
  const auto up = l_prism().intersect({0.5, 2, 0}, {0, 0, 1});
  ASSERT_TRUE(up);
  EXPECT_NEAR(up->enter, 1, 1e-12);
  EXPECT_NEAR(up->exit, 3, 1e-12);
  EXPECT_TRUE(l_prism().intersect({5, 1, 2}, {-1, 0, 0})) << "along a side";
  EXPECT_TRUE(l_prism().intersect({2, 0, 2}, {-1, 1, 0})) << "touches the inner corner";
}

TEST(ConcavePrism, RayEntersThroughTheTopAtTheYOfTheInnerCorner) {
  const auto hit = l_prism().intersect({0.5, 0, 6}, {0, 1, -3});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->enter, 1, 1e-12);
  EXPECT_NEAR(hit->exit, 5.0 / 3, 1e-12);
}

TEST(ConcavePrism, HasAClosedMeshOfItsVolume) {
  for (const Polygon& outline : testing::polygons(7, 60)) {
    const Prism prism(kAxes, outline, 2, 5);
    const Mesh mesh = prism.mesh();
    std::map<std::pair<std::int32_t, std::int32_t>, int> edges;
    double volume = 0;
    const Vector3d origin = mesh.vertices[0];
    for (const auto& face : mesh.faces) {
      for (std::size_t k = 0; k < face.size(); ++k)
        ++edges[{face[k], face[(k + 1) % face.size()]}];
      for (std::size_t k = 2; k < face.size(); ++k) {
        const auto at = [&](std::size_t i) {
          return Vector3d(mesh.vertices[static_cast<std::size_t>(face[i])] - origin);
        };
        volume += at(0).dot(at(k - 1).cross(at(k))) / 6;
      }
    }
    for (const auto& [edge, count] : edges) {
      EXPECT_EQ(count, 1);
      EXPECT_EQ((edges.count({edge.second, edge.first})), 1U);
    }
    EXPECT_NEAR(volume, prism.volume(), 1e-6 * prism.volume());
  }
}

TEST(ConcavePrism, TransformedStaysConcaveAndContainsTheImageExactly) {
  testing::Random random(8);
  std::size_t all = 0;
  for (const Polygon& outline : testing::polygons(8, 120)) {
    const Prism prism(kAxes, outline, 0, 1);
    Eigen::Isometry3d motion = random.isometry(10);
    if (all % 4 == 3) motion.linear().col(1) *= -1;
    const Prism moved = prism.transformed(motion);
    ++all;
    EXPECT_EQ(moved.is_convex(), prism.is_convex()) << all << ", corners: " << outline.size();
    EXPECT_NEAR(moved.footprint_area(), prism.footprint_area(), 1e-3 * prism.footprint_area() + 1e-6);
    for (const Vector2d& corner : outline) {
      const testing::ExactPoint p =
          testing::image(motion, testing::exact(Vector3d(corner.x(), corner.y(), 0.5)));
      ASSERT_TRUE(testing::in_polygon(moved.outline(), testing::dot(moved.axes().col(0), p),
                                      testing::dot(moved.axes().col(1), p)));
    }
    EXPECT_NO_THROW(Prism(moved.axes(), moved.outline(), moved.low(), moved.high()));
  }
}

// The coordinates along one axis are rounded far more than those along the other.
TEST(ConcavePrism, MovedFarAlongOneAxisContainsTheImageExactly) {
  Polygon thirds = testing::l_shape();
  for (Vector2d& corner : thirds)
    corner /= 3;
  const Prism prism(kAxes, thirds, 0, 1);
  for (const Vector3d& far : {Vector3d(1e9, 0, 0), Vector3d(0, 1e9, 0)}) {
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
    motion.translation() = far;
    const Prism moved = prism.transformed(motion);
    EXPECT_FALSE(moved.is_convex());
    EXPECT_NEAR(moved.footprint_area(), prism.footprint_area(), 1e-5);
    for (const Vector2d& corner : thirds) {
      const testing::ExactPoint p =
          testing::image(motion, testing::exact(Vector3d(corner.x(), corner.y(), 0.5)));
      EXPECT_TRUE(testing::in_polygon(moved.outline(), testing::dot(moved.axes().col(0), p),
                                      testing::dot(moved.axes().col(1), p)))
          << corner.transpose() << " moved by " << far.transpose();
    }
  }
}

TEST(ConcavePrism, MovedManyTimesStaysConcave) {
  testing::Random random(9);
  Prism prism = l_prism();
  for (int i = 0; i < 200; ++i)
    prism = prism.transformed(random.isometry(10));
  EXPECT_FALSE(prism.is_convex());
  EXPECT_NEAR(prism.footprint_area(), 7, 1e-9);
}

TEST(ConcavePrism, ABayNarrowerThanRoundingBecomesConvexWhenTransformed) {
  const double step = 0x1p-51;
  const Prism prism(kAxes, {{0, 0}, {4, 0}, {4, 4}, {2 + step, 4}, {2, 1}, {2 - step, 4}, {0, 4}}, 0, 1);
  testing::Random random(10);
  const Prism moved = prism.transformed(random.isometry(10));
  EXPECT_TRUE(moved.is_convex());
  EXPECT_NEAR(moved.footprint_area(), 16, 1e-9);
}

TEST(ConcavePrism, IsConvexIfRoundingRemovesItsOnlyBay) {
  testing::Random random(11);
  int convex = 0;
  for (int i = 0; i < 600; ++i) {
    const double depth = (1 + i % 8) * 0x1p-51;
    const Prism prism(kAxes, {{0, 0}, {4, 0}, {4, 4}, {2, 4 - depth}, {0, 4}}, 0, 1);
    ASSERT_FALSE(prism.is_convex());
    const Prism moved = prism.transformed(random.isometry(10));
    const Prism read(moved.axes(), moved.outline(), moved.low(), moved.high());
    ASSERT_EQ(moved.is_convex(), read.is_convex()) << i;
    ASSERT_EQ(moved.mesh().faces, read.mesh().faces) << i;
    convex += moved.is_convex() ? 1 : 0;
  }
  EXPECT_GT(convex, 0);
}

TEST(ConcavePrism, PairQueriesUseTheConvexHull) {
  const AnyVolume bay = Sphere({1.5, 1.5, 2}, 0.25), outside = Sphere({3.5, 3.5, 2}, 0.25);
  EXPECT_TRUE(overlaps(l_prism(), bay)) << "conservative: the sphere is in the bay";
  EXPECT_FALSE(overlaps(l_prism(), outside));
  EXPECT_NEAR(distance(AnyVolume(l_prism()), outside), distance(AnyVolume(convex_prism(l_prism())), outside),
              1e-12);
}

TEST(ConcavePrism, InflatedContainsAllPointsWithinThePadding) {
  const Prism inflated = inflated_prism(l_prism(), 0.5);
  EXPECT_TRUE(inflated.is_convex());
  for (const Vector2d& corner : testing::l_shape()) {
    for (int k = 0; k < 16; ++k) {
      const Vector2d at = corner + 0.5 * Vector2d(std::cos(0.4 * k), std::sin(0.4 * k));
      EXPECT_TRUE(inflated.contains({at.x(), at.y(), 3.5}));
    }
  }
  EXPECT_EQ(inflated_prism(l_prism(), 0), l_prism());
}

}  // namespace
}  // namespace pcl_bv::detail
