// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Double arithmetic decides nearly every orientation, an exact sum of doubles most others. Rational
// arithmetic decides where products of doubles underflow.

#include "pcl_bv/volumes/planar_hull.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/exact_difference.h"
#include "pcl_bv/numeric/expansion.h"
#include "pcl_bv/volumes/convex_chain.h"

namespace pcl_bv::detail {
namespace {

// Returns the orientation in double arithmetic, or 0 if rounding could have changed its sign. Each product
// has three roundings, and the difference has one. A relative margin of 8 2^-53 covers all roundings.
int rounded_orientation(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const double left = (b.x() - a.x()) * (c.y() - a.y());
  const double right = (b.y() - a.y()) * (c.x() - a.x());
  const double rounding = 0x1p-50 * (std::abs(left) + std::abs(right)) + kSmallestNormal;
  return std::abs(left - right) <= rounding ? 0 : left > right ? 1 : -1;
}

// Returns the support points along eight directions, counter-clockwise.
std::vector<Eigen::Vector2d> octagon(const std::vector<Eigen::Vector2d>& points) {
  constexpr double directions[8][2] = {{0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}};
  std::vector<Eigen::Vector2d> corners;
  for (const auto& [x, y] : directions) {
    const Eigen::Vector2d* farthest = points.data();
    double greatest = -kInfinity;
    for (const Eigen::Vector2d& p : points) {
      const double along = x * p.x() + y * p.y();
      if (!(along > greatest)) continue;
      greatest = along;
      farthest = &p;
    }
    corners.push_back(*farthest);
  }
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

// Returns the positions of all points except those that are certainly to the left of all edges of an octagon
// of points (Akl, Toussaint 1978). A point outside the hull cannot be to the left of all edges of a closed
// polygon of points. Therefore the omitted points are inside the hull, even if rounding changed the choice of
// the octagon's corners.
std::vector<std::size_t> outside_octagon(const std::vector<Eigen::Vector2d>& points) {
  const std::vector<Eigen::Vector2d> corners = octagon(points);
  std::vector<std::size_t> positions;
  for (std::size_t i = 0; i < points.size(); ++i) {
    bool inside = corners.size() > 2;
    for (std::size_t k = 0; k < corners.size() && inside; ++k)
      inside = rounded_orientation(corners[k], corners[(k + 1) % corners.size()], points[i]) > 0;
    if (!inside) positions.push_back(i);
  }
  return positions;
}

int compare(double a, double b) {
  return a < b ? -1 : a > b ? 1 : 0;
}

}  // namespace

int orientation(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  // With the nearest two of the points first, the products and their rounding errors are smallest.
  if (const int certain = rounded_orientation(a, b, c)) return certain;
  if (const int certain = rounded_orientation(b, c, a)) return certain;
  if (const int certain = rounded_orientation(c, a, b)) return certain;
  // Points of lattices are often collinear, and their differences are doubles without rounding. In this case
  // each product is the sum of its rounded value and a rounding error that is also a double. The rounded
  // values are compared first. If these are equal, the errors are compared.
  const double bx = b.x() - a.x(), by = b.y() - a.y(), cx = c.x() - a.x(), cy = c.y() - a.y();
  const double left = bx * cy, right = by * cx;
  const bool doubles = is_exact_difference(b.x(), a.x(), bx) && is_exact_difference(b.y(), a.y(), by) &&
                       is_exact_difference(c.x(), a.x(), cx) && is_exact_difference(c.y(), a.y(), cy);
  constexpr double tiny = 0x1p-900;  // The rounding errors of smaller products may not be doubles.
  const auto fine = [](double u, double v, double product) {
    return u == 0 || v == 0 || (std::abs(product) > tiny && std::isfinite(product));
  };
  if (doubles && fine(bx, cy, left) && fine(by, cx, right)) {
    if (left != right) return compare(left, right);
    return compare(std::fma(bx, cy, -left), std::fma(by, cx, -right));
  }
  // The cross product is a x b + b x c + c x a.
  Expansion sum;
  sum.add_product(a.x(), b.y()).add_product(-a.y(), b.x());
  sum.add_product(b.x(), c.y()).add_product(-b.y(), c.x());
  sum.add_product(c.x(), a.y()).add_product(-c.y(), a.x());
  if (sum.is_lossless()) return sum.sign();
  using Rational = boost::multiprecision::cpp_rational;
  const Rational exact = (Rational(b.x()) - Rational(a.x())) * (Rational(c.y()) - Rational(a.y())) -
                         (Rational(b.y()) - Rational(a.y())) * (Rational(c.x()) - Rational(a.x()));
  return exact.sign();
}

std::vector<std::size_t> planar_hull(const std::vector<Eigen::Vector2d>& points) {
  if (points.empty()) return {};
  std::vector<std::size_t> order = outside_octagon(points);
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    if (points[i].x() != points[j].x()) return points[i].x() < points[j].x();
    if (points[i].y() != points[j].y()) return points[i].y() < points[j].y();
    return i < j;
  });
  const auto equal = [&](std::size_t i, std::size_t j) { return points[i] == points[j]; };
  order.erase(std::unique(order.begin(), order.end(), equal), order.end());
  std::vector<std::size_t> corners =
      convex_chain(order.size(), [&](std::size_t i, std::size_t j, std::size_t k) {
        return orientation(points[order[i]], points[order[j]], points[order[k]]);
      });
  for (std::size_t& corner : corners)
    corner = order[corner];
  return corners;
}

}  // namespace pcl_bv::detail
