// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cmath>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/exact_dot.h"
#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv {

template <typename Vector>
Direction magnitudes(const Vector& v) {
  return {std::abs(v[0]), std::abs(v[1]), std::abs(v[2])};
}

/// How far the double dot product of a scaled direction and a point may be off: its own rounding, that of the
/// direction's tiny components, underflow.
inline double double_error(const Direction& scaled, const Coordinates& p) {
  return (0x1p-50 * dot3(magnitudes(scaled), magnitudes(p)) + 0x1p-1074 * taxicab3(p)) + kSmallestNormal;
}

}  // namespace pcl_bv
