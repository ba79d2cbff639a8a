// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The ends of double by short names.
#pragma once

#include <limits>

namespace pcl_bv::volumes_internal {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Added to a bound, it covers what underflow takes from a product.
inline constexpr double smallest_normal = std::numeric_limits<double>::min();

}  // namespace pcl_bv::volumes_internal
