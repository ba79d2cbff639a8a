// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Directed rounding by error-free transformations. The processor's rounding mode stays unchanged.
#include "pcl_bv/numeric/directed.h"

#include <bit>
#include <cmath>
#include <cstdint>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/expansion.h"

namespace pcl_bv::detail {

double next_up(double x) {
  return std::nextafter(x, kInfinity);
}

double next_down(double x) {
  return std::nextafter(x, -kInfinity);
}

double add_up(double a, double b) {
  return Expansion().add(a).add(b).up();
}

double multiply_up(double a, double b) {
  return Expansion().add_product(a, b).up();
}

double sqrt_up(double a) {
  // For a smaller `a`, std::fma() below may underflow, so `a` is first scaled up.
  if (a > 0 && a < 0x1p-900) return sqrt_up(a * 0x1p200) * 0x1p-100;
  const double root = std::sqrt(a);
  return std::isfinite(root) && std::fma(root, root, -a) < 0 ? next_up(root) : root;
}

double divide_up(double a, double scale) {
  const double quotient = a / scale;
  return quotient * scale < a ? next_up(quotient) : quotient;
}

double divide_down(double a, double scale) {
  return -divide_up(-a, scale);
}

float float_up(double x) {
  const float nearest = static_cast<float>(x);
  if (!(nearest < x)) return nearest;
  // Computes the next float above `nearest` in half the time of std::nextafter. This works because `nearest`
  // is neither NaN nor +infinity nor -0.
  const auto bits = std::bit_cast<std::int32_t>(nearest);
  return std::bit_cast<float>(nearest < 0 ? bits - 1 : bits + 1);
}

float float_down(double x) {
  return -float_up(-x);
}

}  // namespace pcl_bv::detail
