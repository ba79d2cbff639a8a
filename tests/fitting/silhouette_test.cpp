// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "box/silhouette.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <random>

#include "box/gauss_arcs.h"
#include "box/rectangle.h"
#include "box/support_graph.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv::detail {
namespace {

using Corners = std::vector<Eigen::Vector2d>;
using Points = std::vector<Eigen::Vector3d>;

struct Solid {
  Points vertices;
  std::vector<Triangle> triangles;
};

Solid solid(const Points& points) {
  std::vector<Coordinates> all;
  for (const Eigen::Vector3d& p : points)
    all.push_back({p.x(), p.y(), p.z()});
  const ConvexHull hull = convex_hull(all);
  Solid made{{}, hull.triangles};
  for (const std::size_t i : hull.vertices)
    made.vertices.push_back(points[i]);
  return made;
}

// Random, thin, on a lattice and on a ball's: with many vertices in a plane, and many in a line of sight.
std::vector<Solid> solids() {
  std::vector<Solid> all;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal(0, 0.3);
  for (const int n : {4, 5, 8, 30, 400}) {
    Points gauss, thin;
    for (int i = 0; i < n; ++i) {
      gauss.emplace_back(normal(random), normal(random), normal(random));
      thin.emplace_back(normal(random), normal(random), 1e-9 * normal(random));
    }
    all.push_back(solid(gauss));
    all.push_back(solid(thin));
  }
  Points box, ball;
  for (int i = 0; i < 5 * 5 * 5; ++i) {
    const Eigen::Vector3d p(i % 5 - 2, i / 5 % 5 - 2, i / 25 - 2);
    box.push_back(0.25 * p);
    if (p.squaredNorm() <= 5) ball.push_back(0.25 * p);
  }
  all.push_back(solid(box));
  all.push_back(solid(ball));
  return all;
}

Corners chain(const Points& vertices, const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
  Corners corners;
  for (const Eigen::Vector3d& p : vertices)
    corners.emplace_back(dot3(u, p), dot3(v, p));
  corners.resize(to_convex_chain(corners.data(), corners.size()));
  return corners;
}

double area(const Corners& corners) {
  double twice = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d &a = corners[i], &b = corners[(i + 1) % corners.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

// From scattered sides, and along the axes, edges and facets.
std::vector<Eigen::Matrix3d> frames(const Solid& shape) {
  std::vector<Eigen::Matrix3d> all{Eigen::Matrix3d::Identity()};
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 40; ++i) {
    const Eigen::Quaterniond q(normal(random), normal(random), normal(random), normal(random));
    all.push_back(q.normalized().toRotationMatrix());
  }
  for (const Triangle& t : shape.triangles) {
    const auto at = [&](std::size_t k) { return shape.vertices[static_cast<std::size_t>(t[k])]; };
    const Eigen::Vector3d edge = (at(1) - at(0)).normalized();
    const Eigen::Vector3d facet = edge.cross(at(2) - at(0)).normalized();
    Eigen::Matrix3d axes;
    axes << edge, facet, edge.cross(facet);
    all.push_back(axes);
  }
  return all;
}

// The fourth point is so near to the fifth that squares of their distance are 0.
Solid with_a_tiny_edge() {
  return solid({{0, 0, 0}, {1, 0, 0}, {0, -0.5, 0}, {0, 0, 1.5}, {1, -1e-200, 0}});
}

TEST(GaussArcs, HaveUnitNormalsAlthoughTheSquaresOfAnEdgeUnderflow) {
  const Solid shape = with_a_tiny_edge();
  ASSERT_EQ(shape.vertices.size(), 5U);
  const Silhouette silhouette(shape.vertices, shape.triangles);
  SupportGraph graph(silhouette);
  const GaussArcs arcs(silhouette, graph);
  for (const Eigen::Vector3d& n : arcs.nodes)
    EXPECT_NEAR(n.norm(), 1, 1e-15);
  for (const GaussArcs::Arc& arc : arcs.arcs)
    EXPECT_LT(static_cast<std::size_t>(arc.opposite), shape.vertices.size());
}

TEST(SupportGraph, GivesAVertexForDirectionsWithoutALength) {
  const Solid shape = with_a_tiny_edge();
  const Silhouette silhouette(shape.vertices, shape.triangles);
  SupportGraph graph(silhouette);
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               tiny = std::numeric_limits<double>::denorm_min();
  for (const Eigen::Vector3d& d : {Eigen::Vector3d(0, 0, 0),
                                   {nan, nan, nan},
                                   {0, nan, 0},
                                   {1, nan, 1},
                                   {tiny, 0, -tiny},
                                   {0x1p-1020, 0x1p-1020, 0},
                                   {0x1p1000, 0x1p-1000, 0x1p1000}}) {
    const SupportGraph::LowHigh found = graph.support_vertices(d);
    EXPECT_TRUE(found.low >= 0 && found.low < 5 && found.high >= 0 && found.high < 5) << d.transpose();
  }
}

TEST(Silhouette, IsTheOutlineOfAllVertices) {
  for (const Solid& shape : solids()) {
    const Silhouette silhouette(shape.vertices, shape.triangles);
    Silhouette::Projection projection;
    for (const Eigen::Matrix3d& axes : frames(shape)) {
      for (int a = 0; a < 3; ++a) {
        const Eigen::Vector3d u = axes.col((a + 1) % 3), v = axes.col((a + 2) % 3);
        const Corners& seen = silhouette.project(u, v, projection);
        const Corners all = chain(shape.vertices, u, v);
        EXPECT_LE(seen.size(), all.size() + 1);  // the first may be on an edge
        EXPECT_NEAR(area(seen), area(all), 1e-12);
        const Rectangle box = smallest_rectangle(seen.data(), seen.size());
        const Rectangle least = smallest_rectangle(all.data(), all.size());
        EXPECT_NEAR(box.area(), least.area(), 1e-11) << shape.vertices.size() << " vertices\n" << axes;
      }
    }
  }
}

TEST(Silhouette, OfACubeFromACornerIsMadeOfSixEdges) {
  Points cube;
  for (int i = 0; i < 8; ++i)
    cube.emplace_back(i & 1, i >> 1 & 1, i >> 2);
  const Solid shape = solid(cube);
  const Silhouette silhouette(shape.vertices, shape.triangles);
  Silhouette::Projection projection;
  const Eigen::Vector3d u = Eigen::Vector3d(1, -1, 0).normalized(),
                        v = Eigen::Vector3d(1, 1, -2).normalized();
  EXPECT_EQ(silhouette.project(u, v, projection).size(), 6U);
  EXPECT_EQ(projection.rim.size(), 6U);
}

TEST(Silhouette, OfAHullWhoseNormalsVanishIsThatOfItsVertices) {
  Solid shape = solids()[5];
  for (Eigen::Vector3d& p : shape.vertices)
    p *= 1e-170;  // products of two are below 1e-308
  const Silhouette silhouette(shape.vertices, shape.triangles);
  Silhouette::Projection projection;
  const Eigen::Vector3d u = Eigen::Vector3d::UnitX(), v = Eigen::Vector3d::UnitY();
  const Corners seen = silhouette.project(u, v, projection);
  ASSERT_GT(seen.size(), 2U);
  EXPECT_EQ(seen, chain(shape.vertices, u, v));
}

double width_along(const Points& vertices, const Eigen::Vector3d& n) {
  double low = kInfinity, high = -kInfinity;
  for (const Eigen::Vector3d& p : vertices) {
    low = std::min(low, dot3(n, p));
    high = std::max(high, dot3(n, p));
  }
  return high - low;
}

TEST(GaussArcs, BoundTheWidthsAlongTheirNormalsFromBelow) {
  for (const Solid& shape : solids()) {
    for (const Eigen::Vector3d& shift : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(2, -3, 4)}) {
      Points vertices;
      for (const Eigen::Vector3d& p : shape.vertices)
        vertices.emplace_back(p + shift);
      const Silhouette silhouette(vertices, shape.triangles);
      SupportGraph graph(silhouette);
      const GaussArcs gauss(silhouette, graph);
      ASSERT_FALSE(gauss.arcs.empty());
      for (const GaussArcs::Arc& arc : gauss.arcs) {
        EXPECT_LE(gauss.width, arc.width);
        for (const double t : {0.0, 0.2, 0.5, 0.9, 1.0}) {
          const Eigen::Vector3d n = ((1 - t) * gauss.nodes[arc.from] + t * gauss.nodes[arc.to]).normalized();
          EXPECT_LE(arc.width, width_along(vertices, n) + 1e-13) << vertices.size() << " vertices, " << t;
        }
      }
    }
  }
}

TEST(GaussArcs, HaveTheWidthOfABox) {
  Points box;
  for (int i = 0; i < 8; ++i)
    box.emplace_back(3 * (i & 1) + 10, 2 * (i >> 1 & 1), i >> 2);
  const Solid shape = solid(box);
  const Silhouette silhouette(shape.vertices, shape.triangles);
  SupportGraph graph(silhouette);
  EXPECT_DOUBLE_EQ(GaussArcs(silhouette, graph).width, 1);
}

}  // namespace
}  // namespace pcl_bv::detail
