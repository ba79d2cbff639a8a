// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>

#include "exact_integer.h"
#include "hull/convex_hull.h"
#include "pcl_bv/numeric/exact_difference.h"
#include "pcl_bv/numeric/expansion.h"
#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv::detail {
namespace {

Coordinates minus(const Coordinates& b, const Coordinates& a) {
  return {b.x - a.x, b.y - a.y, b.z - a.z};
}

bool is_exact(const Coordinates& b, const Coordinates& a, const Coordinates& difference) {
  return is_exact_difference(b.x, a.x, difference.x) && is_exact_difference(b.y, a.y, difference.y) &&
         is_exact_difference(b.z, a.z, difference.z);
}

// Adds the product a b c to the sum. Returns false if the rounding errors of products are so small that they
// may not be doubles.
bool add_triple(double a, double b, double c, Expansion& sum) {
  const double product = a * b;
  if (product == 0) return a == 0 || b == 0;
  if (std::abs(product) < 0x1p-900) return false;
  sum.add_product(product, c).add_product(std::fma(a, b, -product), c);
  return sum.is_lossless();
}

// The exponents of the lowest and the highest bit of all added coordinates. At least one coordinate must not
// be 0.
struct Bits {
  int lowest = std::numeric_limits<int>::max(), highest = std::numeric_limits<int>::min();

  void add(double x) {
    if (x == 0) return;
    const int exponent = std::ilogb(x);
    lowest = std::min(lowest, exponent - 52);
    highest = std::max(highest, exponent);
  }
};

template <typename Integer>
int by_integers(const Coordinates& a, const Coordinates& b, const Coordinates& c, const Coordinates& p,
                const Bits& bits) {
  const auto integer = [&](double x) { return exact_integer<Integer>(x, bits.lowest); };
  Integer u[3], v[3], w[3];
  for (std::size_t k = 0; k < 3; ++k) {
    const Integer from = integer(a[k]);
    u[k] = integer(b[k]) - from;
    v[k] = integer(c[k]) - from;
    w[k] = integer(p[k]) - from;
  }
  const Integer volume = (u[1] * v[2] - u[2] * v[1]) * w[0] + (u[2] * v[0] - u[0] * v[2]) * w[1] +
                         (u[0] * v[1] - u[1] * v[0]) * w[2];
  return volume.sign();
}

int by_integers(const Coordinates& a, const Coordinates& b, const Coordinates& c, const Coordinates& p) {
  Bits bits;
  for (const Coordinates* q : {&a, &b, &c, &p}) {
    for (std::size_t k = 0; k < 3; ++k)
      bits.add((*q)[k]);
  }
  // If this condition is true, the integers have at most 160 bits. The volume is a sum of products of three
  // differences, so it has less than 490 bits.
  if (bits.highest - bits.lowest < 160) return by_integers<boost::multiprecision::int512_t>(a, b, c, p, bits);
  return by_integers<boost::multiprecision::cpp_int>(a, b, c, p, bits);
}

}  // namespace

int side_of_plane(const Coordinates& a, const Coordinates& b, const Coordinates& c, const Coordinates& p) {
  const Coordinates u = minus(b, a), v = minus(c, a), w = minus(p, a);
  const Coordinates left{u.y * v.z, u.z * v.x, u.x * v.y}, right{u.z * v.y, u.x * v.z, u.y * v.x};
  const double volume = dot3(minus(left, right), w);
  double terms = 0;
  for (std::size_t k = 0; k < 3; ++k)
    terms += (std::abs(left[k]) + std::abs(right[k])) * std::abs(w[k]);
  // Shewchuk's error bound is (7 + 56 u) u times the terms, with u = 2^-53. 1e-200 covers products that
  // underflow, multiplied by differences of at most 2e100.
  if (std::abs(volume) > 0x1p-50 * terms + 1e-200) return volume > 0 ? 1 : -1;
  if (p == a || p == b || p == c) return 0;
  for (std::size_t k = 0; k < 3; ++k) {
    // All points are in a plane perpendicular to an axis, as on walls and floors.
    if (u[k] == 0 && v[k] == 0 && w[k] == 0) return 0;
  }
  if (is_exact(b, a, u) && is_exact(c, a, v) && is_exact(p, a, w)) {
    Expansion sum;
    bool exact = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
      exact = exact && add_triple(u[l], v[m], w[k], sum) && add_triple(-u[m], v[l], w[k], sum);
    }
    if (exact) return sum.sign();
  }
  return by_integers(a, b, c, p);
}

}  // namespace pcl_bv::detail
