// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Rational arithmetic for tests, independent of the library's own.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "pcl_bv/numeric/coordinates.h"
#include "rational.h"

namespace pcl_bv::test {

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

// Rationals are slow, slower yet under an emulator. What double arithmetic puts a billionth of the terms
// inside needs none: that is a million times its rounding error. Underflow may add the least normal number.
inline constexpr double kClearly = 1e-9;
inline constexpr double kUnderflow = std::numeric_limits<double>::min();

/// The rounded d . p and the sum of its terms' magnitudes.
struct RoundedDot {
  double value, terms;
};

template <typename Direction>
RoundedDot rounded_dot(const Direction& d, const Coordinates& p) {
  const double x = d[0] * p.x, y = d[1] * p.y, z = d[2] * p.z;
  return {x + y + z, std::abs(x) + std::abs(y) + std::abs(z)};
}

/// Whether low <= d . p <= high, exactly.
template <typename Direction>
bool exactly_between(double low, const Direction& d, const Coordinates& p, double high) {
  const RoundedDot s = rounded_dot(d, p);
  const double margin = kClearly * (s.terms + std::abs(low) + std::abs(high)) + kUnderflow;
  if (s.value - margin > low && s.value + margin < high) return true;
  const Rational exact = exact_dot(d, p);
  return Rational(low) <= exact && exact <= Rational(high);
}

/// Whether d . p <= high, exactly.
template <typename Direction>
bool exactly_at_most(const Direction& d, const Coordinates& p, double high) {
  const RoundedDot s = rounded_dot(d, p);
  if (s.value + kClearly * (s.terms + std::abs(high)) + kUnderflow < high) return true;
  return exact_dot(d, p) <= Rational(high);
}

/// Whether |p - center| <= radius, exactly.
template <typename Vector>
bool exactly_within(const Vector& center, double radius, const Coordinates& p) {
  const double distance = std::hypot(p.x - center[0], p.y - center[1], p.z - center[2]);
  if (distance + kUnderflow < radius * (1 - kClearly)) return true;
  return exact_squared_distance(center, p) <= Rational(radius) * Rational(radius);
}

/// What the shapes with an axis are decided by: |q|^2, q . a and |a|^2 of q = p - origin, exactly.
struct ExactAlong {
  template <typename Vector>
  ExactAlong(const Vector& origin, const Vector& axis, const Coordinates& p)
      : squared(exact_squared_distance(origin, p)) {
    const double coordinates[] = {p.x, p.y, p.z};
    for (int k = 0; k < 3; ++k) {
      along += (Rational(coordinates[k]) - Rational(origin[k])) * Rational(axis[k]);
      squared_axis += Rational(axis[k]) * Rational(axis[k]);
    }
  }
  Rational squared, along = 0, squared_axis = 0;
};

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
