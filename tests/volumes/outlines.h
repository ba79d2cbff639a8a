// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Simple polygons, and their judge in rationals.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "exact.h"

namespace pcl_bv::testing {

using Polygon = std::vector<Eigen::Vector2d>;

/// The even-odd rule; the boundary is inside.
inline bool in_polygon(const Polygon& corners, const Rational& u, const Rational& v) {
  bool inside = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d &a = corners[i], &b = corners[(i + 1) % corners.size()];
    const Rational left = (Rational(b.x()) - Rational(a.x())) * (v - Rational(a.y()));
    const Rational cross = left - (Rational(b.y()) - Rational(a.y())) * (u - Rational(a.x()));
    const auto between = [](double x, const Rational& at, double y) {
      return Rational(std::min(x, y)) <= at && at <= Rational(std::max(x, y));
    };
    if (cross == 0 && between(a.x(), u, b.x()) && between(a.y(), v, b.y())) return true;
    const bool above_a = Rational(a.y()) <= v, above_b = Rational(b.y()) <= v;
    if (above_a != above_b && (cross > 0) == above_a) inside = !inside;
  }
  return inside;
}

inline Polygon l_shape() {
  return {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}};
}

inline Polygon comb() {
  Polygon corners = {{0, 0}, {9, 0}, {9, 5}};
  for (const double x : {8, 6, 4, 2}) {
    corners.emplace_back(x, 5);
    corners.emplace_back(x - 0.125, 1);
    corners.emplace_back(x - 1, 5);
  }
  corners.emplace_back(0, 5);
  return corners;
}

/// A polygon that is seen whole from its origin.
inline Polygon star(std::mt19937_64& random, std::size_t count, double size, const Eigen::Vector2d& origin) {
  std::uniform_real_distribution<double> radius(0.1, 1), part(0.05, 0.95);
  Polygon corners;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * M_PI * (static_cast<double>(i) + part(random)) / static_cast<double>(count);
    corners.push_back(origin + size * radius(random) * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return corners;
}

/// Polygons of several shapes, sizes and distances from the origin.
inline std::vector<Polygon> polygons(std::uint64_t seed, std::size_t count) {
  std::mt19937_64 random(seed);
  std::vector<Polygon> all = {l_shape(), comb()};
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d origin = i % 3 == 0 ? Eigen::Vector2d(5e5, 4.5e6) : Eigen::Vector2d(0, 0);
    all.push_back(star(random, 5 + i % 40, i % 5 == 0 ? 1e-3 : 20, origin));
  }
  return all;
}

}  // namespace pcl_bv::testing
