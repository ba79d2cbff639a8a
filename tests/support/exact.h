// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Rational arithmetic for tests, independent of the library's own.
#pragma once

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>

#include "pcl_bv/kernels/point_view.h"

namespace pcl_bv::test {

using Rational = boost::multiprecision::cpp_rational;

template <typename Direction>
Rational exact_dot(const Direction& d, const Coordinates& p) {
  return Rational(d[0]) * Rational(p.x) + Rational(d[1]) * Rational(p.y) + Rational(d[2]) * Rational(p.z);
}

template <typename Vector>
Rational exact_squared_distance(const Vector& center, const Coordinates& p) {
  const Rational x = Rational(p.x) - Rational(center[0]);
  const Rational y = Rational(p.y) - Rational(center[1]);
  const Rational z = Rational(p.z) - Rational(center[2]);
  return x * x + y * y + z * z;
}

/// The least double >= the exact value.
inline double least_double_above(const Rational& exact) {
  double d = static_cast<double>(exact);
  const double inf = std::numeric_limits<double>::infinity();
  while (Rational(d) < exact)
    d = std::nextafter(d, inf);
  while (Rational(std::nextafter(d, -inf)) >= exact)
    d = std::nextafter(d, -inf);
  return d;
}

inline double greatest_double_below(const Rational& exact) {
  return -least_double_above(-exact);
}

}  // namespace pcl_bv::test
