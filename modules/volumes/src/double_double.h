// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Double-double numbers, with twice the digits of a double, for differences of nearly equal numbers. Overflow
// and underflow are not handled, so values should be near 1.
#pragma once

#include <cmath>

namespace pcl_bv::detail {

/// The number hi + lo, with |lo| at most half a unit in the last place of hi. The error of a sum or product
/// is about 2^-103 of the magnitudes of its terms (Dekker 1971; Knuth's TwoSum).
struct DoubleDouble {
  DoubleDouble(double value = 0) : hi(value), lo(0) {}
  DoubleDouble(double high, double low) : hi(high + low), lo(low - (hi - high)) {}  // needs |high| >= |low|

  explicit operator double() const { return hi + lo; }

  double hi, lo;
};

inline DoubleDouble exact_sum(double a, double b) {
  const double sum = a + b;
  const double b_part = sum - a;
  DoubleDouble result(sum);
  result.lo = (a - (sum - b_part)) + (b - b_part);
  return result;
}

inline DoubleDouble operator-(const DoubleDouble& a) {
  DoubleDouble result(-a.hi);
  result.lo = -a.lo;
  return result;
}

inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble high = exact_sum(a.hi, b.hi), low = exact_sum(a.lo, b.lo);
  const DoubleDouble sum(high.hi, high.lo + low.hi);
  return {sum.hi, sum.lo + low.lo};
}

inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) {
  return a + -b;
}

inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  const double product = a.hi * b.hi;
  return {product, std::fma(a.hi, b.hi, -product) + (a.hi * b.lo + a.lo * b.hi)};
}

inline DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble first(a.hi / b.hi);
  const DoubleDouble rest = a - first * b;
  return first + DoubleDouble(rest.hi / b.hi);
}

inline bool operator<(const DoubleDouble& a, const DoubleDouble& b) {
  return a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo);
}

inline bool operator>(const DoubleDouble& a, const DoubleDouble& b) {
  return b < a;
}

}  // namespace pcl_bv::detail
