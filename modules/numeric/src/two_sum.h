// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The error-free addition TwoSum (Knuth), which all exact sums use. TwoSum needs -ffp-contract=off and
// rounding to nearest. Include this header in .cpp files only: code in public headers is compiled with the
// user's flags, which may allow contraction.
#pragma once

namespace pcl_bv::detail {

struct TwoSum {
  double sum, error;  // sum + error is exactly a + b
};

inline TwoSum two_sum(double a, double b) {
  const double sum = a + b;
  const double b_part = sum - a;
  const double a_part = sum - b_part;
  return {sum, (a - a_part) + (b - b_part)};
}

}  // namespace pcl_bv::detail
