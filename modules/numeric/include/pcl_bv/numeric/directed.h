// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Arithmetic that rounds to a known side. A bound whose every step rounds outward is itself rounded outward,
// so volumes computed with it enclose their points by exact arithmetic.
//
// The caller of these functions must hold a FloatEnvironment (IEEE default rounding, no flush-to-zero).
#pragma once

namespace [[gnu::visibility("default")]] pcl_bv {

/// Returns the next double above or below x. NaN returns NaN; next_up(+infinity) and next_down(-infinity)
/// return their argument.
double next_up(double x);
double next_down(double x);

/// Returns a + b, a * b or sqrt(a), rounded up to the next double; the exact result if it is a double. If the
/// product's magnitude is below 2^-960, multiply_up() may exceed it by up to the smallest normal double more.
/// Overflow returns +infinity.
double add_up(double a, double b);
double multiply_up(double a, double b);
double sqrt_up(double a);

/// Returns a / scale for a power of two `scale`. The result is exact except where the quotient is a denormal
/// number; there it is rounded up or down.
double divide_up(double a, double scale);
double divide_down(double a, double scale);

/// Returns the smallest float >= x or the largest float <= x. Beyond the range of float that is an infinity
/// or the largest finite float of that sign, depending on the side.
float float_up(double x);
float float_down(double x);

}  // namespace pcl_bv
