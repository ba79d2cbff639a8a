// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The judge of hulls.
#pragma once

#include <algorithm>
#include <array>
#include <set>
#include <utility>
#include <vector>

#include "exact.h"
#include "hull/convex_hull.h"

namespace pcl_bv::test {
using namespace detail;

using ExactPoint = std::array<Rational, 3>;

inline ExactPoint exact(const Coordinates& p) {
  return {Rational(p.x), Rational(p.y), Rational(p.z)};
}

/// Six times the volume of a tetrahedron: positive where a, b and c are counter-clockwise seen from p.
inline Rational volume6(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c, const ExactPoint& p) {
  ExactPoint u, v, w;
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] = b[k] - a[k];
    v[k] = c[k] - a[k];
    w[k] = p[k] - a[k];
  }
  return (u[1] * v[2] - u[2] * v[1]) * w[0] + (u[2] * v[0] - u[0] * v[2]) * w[1] +
         (u[0] * v[1] - u[1] * v[0]) * w[2];
}

/// Whether each edge of a triangle is, the other way round, an edge of another one.
inline bool is_closed(const std::vector<detail::Triangle>& triangles) {
  std::set<std::pair<std::int32_t, std::int32_t>> edges;
  for (const detail::Triangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (!edges.insert({t[k], t[(k + 1) % 3]}).second) return false;
    }
  }
  return std::all_of(edges.begin(), edges.end(), [&](const auto& e) {
    return edges.count({e.second, e.first}) == 1;
  });
}

}  // namespace pcl_bv::test
