// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "hull/convex_hull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <set>

#include "pcl_bv/numeric/float_environment.h"
#include "solids.h"

namespace pcl_bv::detail {
namespace {

using test::exact;
using test::is_closed;
using test::volume6;
using Points = std::vector<Coordinates>;

Points chosen(const Points& points, const std::vector<std::size_t>& positions) {
  Points found;
  for (const std::size_t i : positions)
    found.push_back(points[i]);
  return found;
}

std::set<std::array<double, 3>> places(const Points& points) {
  std::set<std::array<double, 3>> found;
  for (const Coordinates& p : points)
    found.insert({p.x, p.y, p.z});
  return found;
}

bool sees_any(const Coordinates& p, const Points& vertices, const std::vector<Triangle>& triangles) {
  const auto at = [&](std::int32_t i) { return exact(vertices[static_cast<std::size_t>(i)]); };
  return std::any_of(triangles.begin(), triangles.end(),
                     [&](const Triangle& t) { return volume6(at(t[0]), at(t[1]), at(t[2]), exact(p)) > 0; });
}

// All points are in the surface, and each vertex is outside of the hull of the others.
void expect_hull_by_definition(const Points& points) {
  const ConvexHull hull = convex_hull(points);
  const Points vertices = chosen(points, hull.vertices);
  ASSERT_GE(vertices.size(), 4u);
  EXPECT_TRUE(is_closed(hull.triangles));
  EXPECT_EQ(hull.triangles.size(), 2 * vertices.size() - 4);
  for (const Coordinates& p : points)
    ASSERT_FALSE(sees_any(p, vertices, hull.triangles));
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    Points others = vertices;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const ConvexHull smaller = convex_hull(others);
    // What is left of a pyramid without its apex is flat.
    if (!smaller.triangles.empty()) {
      ASSERT_TRUE(sees_any(vertices[i], chosen(others, smaller.vertices), smaller.triangles)) << i;
    }
  }
}

// Leaving out what is no vertex changes nothing, another order nothing but the numbers.
void expect_of_vertices_alone(Points points, std::uint64_t seed) {
  const ConvexHull hull = convex_hull(points);
  const Points vertices = chosen(points, hull.vertices);
  const ConvexHull again = convex_hull(vertices);
  EXPECT_EQ(again.vertices.size(), vertices.size());
  EXPECT_EQ(again.triangles, hull.triangles);
  std::shuffle(points.begin(), points.end(), std::mt19937_64(seed));
  EXPECT_EQ(places(chosen(points, convex_hull(points).vertices)), places(vertices));
}

struct Family {
  const char* name;
  std::function<Coordinates(std::mt19937_64&)> point;
};

double unit(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-52 - 1;
}

// Step by step of a tenth, which is none in binary: in one plane but for the last bits.
double tenth(std::mt19937_64& random) {
  return static_cast<double>(random() % 10) * 0.1;
}

const std::vector<Family>& families() {
  static const std::vector<Family> all = {
      {"ball",
       [](auto& r) {
         return Coordinates{unit(r), unit(r), unit(r)};
       }},
      {"floats far away",
       [](auto& r) {
         return Coordinates{float(5e6 + unit(r)), float(4e5 + unit(r)), float(unit(r))};
       }},
      {"lattice",
       [](auto& r) {
         return Coordinates{double(r() % 4), double(r() % 4), double(r() % 4)};
       }},
      {"tenths",
       [](auto& r) {
         return Coordinates{tenth(r), tenth(r), tenth(r)};
       }},
      {"near a tilted plane",
       [](auto& r) {
         const double x = tenth(r), y = tenth(r);
         return Coordinates{x, y, std::nextafter(x + 2 * y, double(r() % 3) - 1)};
       }},
      {"near a line",
       [](auto& r) {
         const double x = unit(r);
         return Coordinates{x, x / 3, std::nextafter(x / 7, double(r() % 3) - 1)};
       }},
      {"tiny",
       [](auto& r) {
         return Coordinates{1e-310 * unit(r), 1e-310 * unit(r), 1e-310 * unit(r)};
       }},
      {"huge",
       [](auto& r) {
         return Coordinates{1e100 * unit(r), 1e100 * unit(r), 1e100 * unit(r)};
       }},
      {"of all sizes",
       [](auto& r) {
         return Coordinates{1e90 * unit(r), unit(r), 1e-90 * unit(r)};
       }},
      {"two needles",
       [](auto& r) {
         return r() % 2 == 0 ? Coordinates{unit(r), 0, 0} : Coordinates{0, 1e-30 * unit(r), 1};
       }},
  };
  return all;
}

TEST(ConvexHull, HasThePointsThatAreNotInTheHullOfOthers) {
  const FloatEnvironment environment;
  for (const Family& family : families()) {
    for (const std::size_t n : {6u, 12u, 40u}) {
      for (std::uint64_t seed = 0; seed < 5; ++seed) {
        SCOPED_TRACE(testing::Message() << family.name << ", " << n << " points, seed " << seed);
        std::mt19937_64 random(seed);
        Points points;
        while (points.size() < n)
          points.push_back(family.point(random));
        if (!convex_hull(points).triangles.empty()) expect_hull_by_definition(points);
        expect_of_vertices_alone(points, seed);
      }
    }
  }
}

TEST(ConvexHull, OfManyPointsIsThatOfItsVertices) {
  const FloatEnvironment environment;
  for (const Family& family : families()) {
    SCOPED_TRACE(family.name);
    std::mt19937_64 random(1);
    Points points;
    while (points.size() < 3000)
      points.push_back(family.point(random));
    expect_of_vertices_alone(points, 2);
  }
}

TEST(ConvexHull, OfEqualPointsHasTheFirst) {
  const FloatEnvironment environment;
  const Points corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Points points;
  for (int copy = 0; copy < 3; ++copy)
    points.insert(points.end(), corners.rbegin(), corners.rend());
  EXPECT_EQ(convex_hull(points).vertices, (std::vector<std::size_t>{0, 1, 2, 3}));
}

TEST(ConvexHull, OfPointsInAPlaneOrLessIsAPolygonItsEndsOrAPoint) {
  const FloatEnvironment environment;
  EXPECT_TRUE(convex_hull({}).vertices.empty());
  EXPECT_EQ(convex_hull({{1, 2, 3}, {1, 2, 3}}).vertices, (std::vector<std::size_t>{0}));
  for (const Coordinates& step : {Coordinates{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 2, -3}}) {
    Points line, square;
    for (int i = 0; i < 50; ++i) {
      const double s = i * 7 % 50, t = s * s;
      line.push_back({s * step.x, s * step.y, s * step.z});
      // Of a parabola all points are corners.
      square.push_back({s * step.x + t * step.y, s * step.y + t * step.z, s * step.z + t * step.x});
    }
    const ConvexHull ends = convex_hull(line);
    EXPECT_EQ(places(chosen(line, ends.vertices)), places({line[0], line[7]}));  // 0 and 49
    EXPECT_EQ(convex_hull(square).vertices.size(), 50u);
    EXPECT_TRUE(ends.triangles.empty());
  }
}

TEST(SideOfPlane, IsThatOfExactArithmetic) {
  const FloatEnvironment environment;
  std::mt19937_64 random(3);
  int in_plane = 0;
  for (const Family& family : families()) {
    for (int i = 0; i < 3000; ++i) {
      Coordinates p[4];
      for (Coordinates& q : p)
        q = family.point(random);
      if (i % 3 == 0) p[3] = {p[1].x + p[2].x - p[0].x, p[1].y + p[2].y - p[0].y, p[1].z + p[2].z - p[0].z};
      if (i % 50 == 0) p[3] = p[random() % 3];
      const int sign = volume6(exact(p[0]), exact(p[1]), exact(p[2]), exact(p[3])).sign();
      ASSERT_EQ(side_of_plane(p[0], p[1], p[2], p[3]), (sign > 0) - (sign < 0)) << family.name << ", " << i;
      in_plane += sign == 0 ? 1 : 0;
    }
  }
  EXPECT_GT(in_plane, 1000);
}

}  // namespace
}  // namespace pcl_bv::detail
