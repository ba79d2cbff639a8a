// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Plain double decides nearly every turn, rationals the others.

#include "hull/planar_hull.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

#include "hull/exact_difference.h"
#include "pcl_bv/numeric/constants.h"

namespace pcl_bv {
namespace {

// 0 if rounding could have turned it. Three roundings of each product and one of the difference: 8 2^-53 is
// more than that.
int clear_turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const double left = (b.x() - a.x()) * (c.y() - a.y());
  const double right = (b.y() - a.y()) * (c.x() - a.x());
  const double rounding = 0x1p-50 * (std::abs(left) + std::abs(right)) + kSmallestNormal;
  return std::abs(left - right) <= rounding ? 0 : left > right ? 1 : -1;
}

// The points that reach farthest in eight directions, counter-clockwise.
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

// Positions of the points that are not surely to the left of all edges of an octagon of points (Akl,
// Toussaint 1978). Around a point that is outside of the hull no closed line turns left all the way, so the
// others are inside, whichever corners rounding has chosen.
std::vector<std::size_t> near_outline(const std::vector<Eigen::Vector2d>& points) {
  const std::vector<Eigen::Vector2d> corners = octagon(points);
  std::vector<std::size_t> positions;
  for (std::size_t i = 0; i < points.size(); ++i) {
    bool inside = corners.size() > 2;
    for (std::size_t k = 0; k < corners.size() && inside; ++k)
      inside = clear_turn(corners[k], corners[(k + 1) % corners.size()], points[i]) > 0;
    if (!inside) positions.push_back(i);
  }
  return positions;
}

// Keeps those corners of the chain that turn left. `last` ends the chain that the other one has built.
void extend_chain(const std::vector<Eigen::Vector2d>& points, std::size_t next, std::size_t first,
                  std::vector<std::size_t>& chain) {
  while (chain.size() >= first + 2 &&
         turn(points[chain[chain.size() - 2]], points[chain.back()], points[next]) <= 0)
    chain.pop_back();
  chain.push_back(next);
}

int compare(double a, double b) {
  return a < b ? -1 : a > b ? 1 : 0;
}

}  // namespace

int turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  if (const int clear = clear_turn(a, b, c)) return clear;
  // Lattices have many points in a row, and differences that are doubles: then each product is one and its
  // rounding error, and the rounded ones decide unless they are equal.
  const double bx = b.x() - a.x(), by = b.y() - a.y(), cx = c.x() - a.x(), cy = c.y() - a.y();
  const double left = bx * cy, right = by * cx;
  const bool doubles = is_exact_difference(b.x(), a.x(), bx) && is_exact_difference(b.y(), a.y(), by) &&
                       is_exact_difference(c.x(), a.x(), cx) && is_exact_difference(c.y(), a.y(), cy);
  constexpr double tiny = 0x1p-900;  // below, errors of products are no doubles
  const auto fine = [](double u, double v, double product) {
    return u == 0 || v == 0 || (std::abs(product) > tiny && std::isfinite(product));
  };
  if (doubles && fine(bx, cy, left) && fine(by, cx, right)) {
    if (left != right) return compare(left, right);
    return compare(std::fma(bx, cy, -left), std::fma(by, cx, -right));
  }
  using Rational = boost::multiprecision::cpp_rational;
  const Rational exact = (Rational(b.x()) - Rational(a.x())) * (Rational(c.y()) - Rational(a.y())) -
                         (Rational(b.y()) - Rational(a.y())) * (Rational(c.x()) - Rational(a.x()));
  return exact.sign();
}

std::vector<std::size_t> planar_hull(const std::vector<Eigen::Vector2d>& points) {
  if (points.empty()) return {};
  std::vector<std::size_t> order = near_outline(points);
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    if (points[i].x() != points[j].x()) return points[i].x() < points[j].x();
    if (points[i].y() != points[j].y()) return points[i].y() < points[j].y();
    return i < j;
  });
  const auto equal = [&](std::size_t i, std::size_t j) { return points[i] == points[j]; };
  order.erase(std::unique(order.begin(), order.end(), equal), order.end());
  if (order.size() < 3) return order;
  std::vector<std::size_t> chain;
  for (const std::size_t i : order)
    extend_chain(points, i, 0, chain);
  const std::size_t lower = chain.size() - 1;
  for (std::size_t k = order.size() - 1; k-- > 0;)
    extend_chain(points, order[k], lower, chain);
  chain.pop_back();  // the first one again
  return chain;
}

}  // namespace pcl_bv
