// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Arithmetic with a known side of the error. Enclosure by exact arithmetic is then proven by composition:
// each step of a bound rounds outward, so the whole does.
//
// All of it expects the IEEE default environment: hold a FloatEnvironment.
#pragma once

namespace [[gnu::visibility("default")]] pcl_bv {

/// The next double above, and below. NaN and the infinity on that side stay what they are.
double next_up(double x);
double next_down(double x);

/// a + b, a * b and sqrt(a) in exact arithmetic, rounded up to a double; where the product is below 2^-960,
/// up to a smallest normal further. Infinite on overflow.
double add_up(double a, double b);
double multiply_up(double a, double b);
double sqrt_up(double a);

/// a / scale for a power of two: exact but where the quotient is a denormal number; there rounded up, and
/// down.
double divide_up(double a, double scale);
double divide_down(double a, double scale);

/// The smallest float not below x, the greatest not above. Infinite beyond the range of float.
float float_up(double x);
float float_down(double x);

}  // namespace pcl_bv
