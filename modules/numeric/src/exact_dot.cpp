// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Expansions are exact unless a product is so small that its rounding error may be below 2^-1074, the
// smallest positive double. In that case rational arithmetic computes the result, a thousand times slower.

#include "pcl_bv/numeric/exact_dot.h"

#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/exact_sum.h"
#include "pcl_bv/numeric/expansion.h"

namespace pcl_bv::detail {
namespace {

using Rational = boost::multiprecision::cpp_rational;

Rational exact_dot(const Direction& n, const Coordinates& p) {
  return Rational(n[0]) * Rational(p.x) + Rational(n[1]) * Rational(p.y) + Rational(n[2]) * Rational(p.z);
}

double rounded_up(const Rational& exact) {
  double rounded = static_cast<double>(exact);
  while (Rational(rounded) < exact)
    rounded = next_up(rounded);
  while (Rational(next_down(rounded)) >= exact)
    rounded = next_down(rounded);
  return rounded;
}

// Returns the number of significand bits from the leading to the last set bit. For denormal numbers the
// result is too large, which only makes is_exact() return false.
int width(double value) {
  const std::uint64_t fraction = std::bit_cast<std::uint64_t>(value) & 0xF'FFFF'FFFF'FFFFU;
  return fraction == 0 ? 1 : 53 - std::countr_zero(fraction);
}

bool is_exact(double product, double a, double b) {
  if (a == 0 || b == 0 || a == 1 || a == -1) return true;
  const int wide = width(a), other = width(b);
  return (wide == 1 || other == 1 || wide + other <= 53) && std::abs(product) >= 0x1p-960;
}

// A projection in double arithmetic, by three products and two sums. The error of value() is at most
// 3.01 * 2^-53 of magnitude().
struct Rounded {
  Rounded(const Direction& n, const Coordinates& p) : x(n[0] * p.x), y(n[1] * p.y), z(n[2] * p.z) {}

  double value() const { return (x + y) + z; }
  double magnitude() const { return (std::abs(x) + std::abs(y)) + std::abs(z); }
  bool has_exact_products(const Direction& n, const Coordinates& p) const {
    return is_exact(x, n[0], p.x) && is_exact(y, n[1], p.y) && is_exact(z, n[2], p.z);
  }
  ExactSum sum() const { return exact_sum(x, y, z); }

  double x, y, z;
};

// Not inlined, because the stack that expansions and rationals need would considerably slow down the usual
// case of compare_along(). If all magnitudes are tiny, scaling by a power of two keeps the products exact.
[[gnu::noinline]] int compare_exactly(const Direction& n, const Coordinates& p, const Coordinates& q,
                                      double magnitude) {
  const double scale = magnitude < 0x1p-400 ? 0x1p500 : 1;
  const Coordinates scaled{scale * p.x, scale * p.y, scale * p.z};
  const Coordinates other{-scale * q.x, -scale * q.y, -scale * q.z};
  const Expansion exact = Expansion().add_dot(n, scaled).add_dot(n, other);
  return exact.is_lossless() ? exact.sign() : (exact_dot(n, p) - exact_dot(n, q)).sign();
}

[[gnu::noinline]] double project_exactly_up(const Direction& n, const Coordinates& p) {
  const Expansion exact = Expansion().add_dot(n, p);
  return (exact.is_lossless() ? exact.up() : rounded_up(exact_dot(n, p))) + 0.0;
}

}  // namespace

int compare_along(const Direction& n, const Coordinates& p, const Coordinates& q) {
  // If n is parallel to a coordinate axis, it is enough to compare the coordinates along that axis. Most ties
  // are of this kind, because all points of an axis-aligned wall have the same coordinate along one axis.
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (n[(axis + 1) % 3] != 0 || n[(axis + 2) % 3] != 0) continue;
    const int order = (p[axis] > q[axis]) - (p[axis] < q[axis]);
    return n[axis] < 0 ? -order : n[axis] > 0 ? order : 0;
  }
  const Rounded a(n, p);
  const Rounded b(n, q);
  const double difference = a.value() - b.value();
  // kSmallestNormal covers products that underflow.
  const double error_bound = 0x1p-51 * (a.magnitude() + b.magnitude()) + kSmallestNormal;
  if (difference > error_bound) return 1;
  if (difference < -error_bound) return -1;
  // Products of floats with small integers or powers of two are exact. For such products, deciding a tie
  // takes 20 ns with exact_sum(), but 48 ns with expansions.
  if (a.has_exact_products(n, p) && b.has_exact_products(n, q)) return compare(a.sum(), b.sum());
  return compare_exactly(n, p, q, a.magnitude() + b.magnitude());
}

double project_up(const Direction& n, const Coordinates& p) {
  const Rounded rounded(n, p);
  if (rounded.has_exact_products(n, p)) return round_up(rounded.sum());
  return project_exactly_up(n, p);
}

double project_down(const Direction& n, const Coordinates& p) {
  return -project_up({-n[0], -n[1], -n[2]}, p) + 0.0;
}

}  // namespace pcl_bv::detail
