// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Polynomials on [0, 1] in Bernstein form. A polynomial in this form is nowhere below its smallest
// coefficient.
#pragma once

#include <algorithm>
#include <array>

namespace pcl_bv::detail {

using Linear = std::array<double, 2>;
using Quadratic = std::array<double, 3>;
using Quartic = std::array<double, 5>;

inline Quadratic product(const Linear& a, const Linear& b) {
  return {a[0] * b[0], 0.5 * (a[0] * b[1] + a[1] * b[0]), a[1] * b[1]};
}

inline Quartic product(const Quadratic& a, const Quadratic& b) {
  return {a[0] * b[0], 0.5 * (a[0] * b[1] + a[1] * b[0]), (a[0] * b[2] + 4 * (a[1] * b[1]) + a[2] * b[0]) / 6,
          0.5 * (a[1] * b[2] + a[2] * b[1]), a[2] * b[2]};
}

template <std::size_t n>
bool any_negative(const std::array<double, n>& coefficients) {
  return *std::min_element(coefficients.begin(), coefficients.end()) < 0;
}

/// Returns the value at t (de Casteljau's algorithm).
template <std::size_t n>
double value_at(std::array<double, n> coefficients, double t) {
  for (std::size_t left = n - 1; left > 0; --left) {
    for (std::size_t i = 0; i < left; ++i)
      coefficients[i] += t * (coefficients[i + 1] - coefficients[i]);
  }
  return coefficients[0];
}

}  // namespace pcl_bv::detail
