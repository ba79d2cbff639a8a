// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// std::ilogb() and std::ldexp() without a call for usual numbers. The results are the same.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Returns std::ilogb(x).
inline int binary_exponent(double x) {
  const int biased = static_cast<int>(std::bit_cast<std::uint64_t>(x) >> 52 & 0x7FF);
  return biased > 0 && biased < 0x7FF ? biased - 1023 : std::ilogb(x);
}

/// Returns std::ldexp(x, exponent). The product by a power of two is rounded only if it is denormal, as in
/// ldexp().
inline double times_power_of_two(double x, int exponent) {
  if (exponent < -1022 || exponent > 1023) return std::ldexp(x, exponent);
  return x * std::bit_cast<double>(static_cast<std::uint64_t>(1023 + exponent) << 52);
}

}  // namespace detail
}  // namespace pcl_bv
