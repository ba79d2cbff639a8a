// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Doubles as exact integers, for predicates. Rationals would be reduced after each operation.
#pragma once

#include <cmath>
#include <cstdint>

namespace pcl_bv::detail {

/// Returns x * 2^-lowest without rounding. `lowest` must be at most std::ilogb(x) - 52; -1126 is for any x.
template <typename Integer>
Integer exact_integer(double x, int lowest) {
  if (x == 0) return Integer(0);
  const int exponent = std::ilogb(x) - 52;
  return Integer(Integer(static_cast<std::int64_t>(std::ldexp(x, -exponent))) << (exponent - lowest));
}

}  // namespace pcl_bv::detail
