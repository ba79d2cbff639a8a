// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A test whether a difference of doubles is free of rounding.
#pragma once

namespace pcl_bv::detail {

/// Returns whether `difference`, which is b - a rounded to a double, equals b - a exactly.
inline bool is_exact_difference(double b, double a, double difference) {
  const double back = difference - b;
  return b - (difference - back) == 0 && -a - back == 0;
}

}  // namespace pcl_bv::detail
