// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "hull/convex_hull.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "hull/quickhull.h"
#include "local_frame.h"
#include "pcl_bv/volumes/planar_hull.h"

namespace pcl_bv::detail {
namespace {

bool in_line(const std::vector<Coordinates>& points, std::size_t a, std::size_t b, std::size_t c) {
  for (std::size_t k = 0; k < 3; ++k) {
    const auto flat = [&](std::size_t i) { return Eigen::Vector2d(points[i][k], points[i][(k + 1) % 3]); };
    if (orientation(flat(a), flat(b), flat(c)) != 0) return false;
  }
  return true;
}

// Appends the first point with the largest measure. If good() is false for this point, appends the first
// point for which good() is true. Returns false if good() is false for all points.
template <typename Measure, typename Good>
bool find(const std::vector<Coordinates>& points, const Measure& measure, const Good& good,
          std::vector<std::size_t>& corners) {
  std::size_t best = 0;
  double greatest = -1;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double measured = measure(vector(points[i]));
    if (!(measured > greatest)) continue;
    greatest = measured;
    best = i;
  }
  for (std::size_t i = 0; !good(best) && i < points.size(); ++i)
    best = i;
  if (!good(best)) return false;
  corners.push_back(best);
  return true;
}

// Returns the positions of a few points that span as many dimensions as all points together. These are four
// points unless all points are in a plane.
std::vector<std::size_t> spanning(const std::vector<Coordinates>& points) {
  std::vector<std::size_t> corners{0};
  const Eigen::Vector3d a = vector(points[0]);
  const auto distance = [&](const Eigen::Vector3d& p) { return (p - a).cwiseAbs().maxCoeff(); };
  const auto apart = [&](std::size_t i) { return !(points[i] == points[0]); };
  if (!find(points, distance, apart, corners)) return corners;
  const Eigen::Vector3d ab = vector(points[corners[1]]) - a;
  const auto across = [&](const Eigen::Vector3d& p) { return ab.cross(p - a).cwiseAbs().maxCoeff(); };
  const auto aside = [&](std::size_t i) { return !in_line(points, 0, corners[1], i); };
  if (!find(points, across, aside, corners)) return corners;
  const Eigen::Vector3d normal = ab.cross(vector(points[corners[2]]) - a);
  const auto height = [&](const Eigen::Vector3d& p) { return std::abs(normal.dot(p - a)); };
  const auto off = [&](std::size_t i) {
    return side_of_plane(points[0], points[corners[1]], points[corners[2]], points[i]) != 0;
  };
  find(points, height, off, corners);
  return corners;
}

// Returns the corners that are extreme points. These are the corners in the planes of three or more faces.
// Any other corner is inside a face or an edge.
std::vector<std::size_t> extreme_corners(const std::vector<Triangle>& triangles,
                                         const std::vector<std::size_t>& faces) {
  std::vector<std::pair<std::size_t, std::size_t>> planes;  // (corner, face)
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const std::int32_t corner : triangles[t])
      planes.emplace_back(static_cast<std::size_t>(corner), faces[t]);
  }
  std::sort(planes.begin(), planes.end());
  planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
  std::vector<std::size_t> extreme;
  for (std::size_t i = 2; i < planes.size(); ++i) {
    const std::size_t corner = planes[i].first;
    if (planes[i - 2].first == corner && (extreme.empty() || extreme.back() != corner))
      extreme.push_back(corner);
  }
  return extreme;
}

// Returns the extreme points of points in a plane, on a line or at one position. Drops one coordinate, chosen
// such that the points span as many dimensions as before. The same points are extreme without this
// coordinate.
std::vector<std::size_t> extreme_in_plane(const std::vector<Coordinates>& points,
                                          const std::vector<std::size_t>& corners) {
  if (corners.size() < 2) return corners;
  const auto at = [&](std::size_t i) { return vector(points[corners[i]]); };
  std::size_t dropped = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto flat = [&](std::size_t i) { return Eigen::Vector2d(at(i)[(k + 1) % 3], at(i)[(k + 2) % 3]); };
    const bool spans = corners.size() < 3 ? flat(0) != flat(1) : orientation(flat(0), flat(1), flat(2)) != 0;
    if (spans) dropped = k;
  }
  std::vector<Eigen::Vector2d> flat;
  flat.reserve(points.size());
  for (const Coordinates& p : points)
    flat.emplace_back(p[(dropped + 1) % 3], p[(dropped + 2) % 3]);
  std::vector<std::size_t> extreme = planar_hull(flat);
  std::sort(extreme.begin(), extreme.end());
  return extreme;
}

void begin_with_smallest(std::vector<Triangle>& triangles) {
  for (Triangle& t : triangles)
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
}

// Returns the exponent of the power of two by which the coordinates along an axis are multiplied: 0 unless
// all of them are tiny.
int enlargement(const std::vector<Coordinates>& points, std::size_t axis) {
  constexpr double kTiny = 0x1p-100;
  double largest = 0;
  for (const Coordinates& p : points)
    largest = std::max(largest, std::abs(p[axis]));
  return largest > 0 && largest < kTiny ? -std::ilogb(largest) : 0;
}

ConvexHull hull_of(const std::vector<Coordinates>& points) {
  ConvexHull hull;
  if (points.empty()) return hull;
  const std::vector<std::size_t> corners = spanning(points);
  if (corners.size() < 4) {
    hull.vertices = extreme_in_plane(points, corners);
    return hull;
  }
  std::array<std::int32_t, 4> first;
  std::copy(corners.begin(), corners.end(), first.begin());
  const Quickhull quickhull(points, first);
  hull.triangles = quickhull.triangles();
  const std::vector<std::size_t> faces = quickhull.faces();
  hull.vertices = extreme_corners(hull.triangles, faces);
  std::vector<std::size_t> distinct = faces;
  std::sort(distinct.begin(), distinct.end());
  const bool cut = std::adjacent_find(distinct.begin(), distinct.end()) != distinct.end();
  // The division of a face into triangles depends on all points that Quickhull added. The hull of the
  // vertices alone is computed here, so that the division depends on the vertices alone.
  if (cut && hull.vertices.size() < points.size()) {
    std::vector<Coordinates> extreme;
    for (const std::size_t i : hull.vertices)
      extreme.push_back(points[i]);
    hull.triangles = hull_of(extreme).triangles;
    return hull;
  }
  std::vector<std::int32_t> number(points.size());
  for (std::size_t i = 0; i < hull.vertices.size(); ++i)
    number[hull.vertices[i]] = static_cast<std::int32_t>(i);
  for (Triangle& t : hull.triangles) {
    for (std::int32_t& corner : t)
      corner = number[static_cast<std::size_t>(corner)];
  }
  begin_with_smallest(hull.triangles);
  return hull;
}

}  // namespace

// Enlarging an axis does not change which points are extreme. With tiny coordinates, products would
// underflow, and every point would be compared in integers.
ConvexHull convex_hull(const std::vector<Coordinates>& points) {
  const int x = enlargement(points, 0), y = enlargement(points, 1), z = enlargement(points, 2);
  if (x == 0 && y == 0 && z == 0) return hull_of(points);
  std::vector<Coordinates> enlarged;
  enlarged.reserve(points.size());
  for (const Coordinates& p : points)
    enlarged.push_back({std::ldexp(p.x, x), std::ldexp(p.y, y), std::ldexp(p.z, z)});
  return hull_of(enlarged);
}

}  // namespace pcl_bv::detail
