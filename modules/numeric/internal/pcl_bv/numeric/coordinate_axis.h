// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Whether projections on a direction are coordinates, without any rounding.
#pragma once

#include <cmath>
#include <optional>

namespace pcl_bv::detail {

/// Returns k if v is exactly the unit vector of coordinate k, or the opposite vector. Otherwise returns
/// nothing. Each component decides, and no sum or length does, because 1 + 1e-17 rounds to 1.
template <typename Vector>
inline std::optional<int> coordinate_axis(const Vector& v) {
  for (int k = 0; k < 3; ++k) {
    if (std::abs(v[k]) == 1 && v[(k + 1) % 3] == 0 && v[(k + 2) % 3] == 0) return k;
  }
  return std::nullopt;
}

}  // namespace pcl_bv::detail
