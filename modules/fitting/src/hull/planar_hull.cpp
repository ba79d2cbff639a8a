// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Plain double decides nearly every turn, rationals the others.

#include "hull/planar_hull.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <numeric>

#include "hull/exact_difference.h"
#include "pcl_bv/numeric/constants.h"

namespace pcl_bv {
namespace {

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
  const double left = (b.x() - a.x()) * (c.y() - a.y());
  const double right = (b.y() - a.y()) * (c.x() - a.x());
  // Three roundings of each product and one of the difference: 8 2^-53 is more than that.
  const double doubt = 0x1p-50 * (std::abs(left) + std::abs(right)) + kSmallestNormal;
  if (std::abs(left - right) > doubt) return left > right ? 1 : -1;
  // Lattices have many points in a row, and differences that are doubles: then each product is one and its
  // rounding error, and the rounded ones decide unless they are equal.
  const double bx = b.x() - a.x(), by = b.y() - a.y(), cx = c.x() - a.x(), cy = c.y() - a.y();
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
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
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
