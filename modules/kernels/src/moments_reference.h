// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The scalar reference of moments.cpp: what its vectors must agree with.
#pragma once

#include "pcl_bv/kernels/moments.h"

namespace pcl_bv {

Moments block_moments_reference(const PointView& block);

/// Calls sum(moments) with the exponents that doubles may need, until the sums are not too small.
template <typename Sum>
void sum_with_room(ScalarType scalar, Moments& moments, const Sum& sum) {
  for (moments.exponent = 0;; moments.exponent += 500) {
    sum(moments);
    const double squares = (moments.product[0] + moments.product[3]) + moments.product[5];
    if (scalar == ScalarType::float32 || moments.exponent == 1000 || squares >= 0x1p-660) return;
  }
}

}  // namespace pcl_bv
