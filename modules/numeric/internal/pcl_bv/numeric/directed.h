// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Arithmetic that rounds up or down. If every step of the computation of an upper bound rounds up, the result
// is not below the exact bound. A volume with such bounds certainly encloses its points.
//
// The caller of these functions must hold a FloatEnvironment (IEEE default rounding, no flush-to-zero).
#pragma once

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Returns the next double above or below x. NaN returns NaN; next_up(+infinity) and next_down(-infinity)
/// return their argument.
double next_up(double x);
double next_down(double x);

/// Returns the smallest double >= a + b, a * b or sqrt(a). If the magnitude of the product is below 2^-960,
/// the result of multiply_up() may exceed a * b by about the smallest normal double. Overflow returns
/// +infinity.
double add_up(double a, double b);
double multiply_up(double a, double b);
double sqrt_up(double a);

/// Returns a / scale for a power of two `scale`. The result is exact unless the quotient is a denormal
/// number, which divide_up() rounds up and divide_down() rounds down.
double divide_up(double a, double scale);
double divide_down(double a, double scale);

/// Returns the smallest float >= x or the largest float <= x. For x beyond the range of float, the result is
/// an infinity or the finite float of largest magnitude, with the sign of x.
float float_up(double x);
float float_down(double x);

}  // namespace detail
}  // namespace pcl_bv
