// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <limits>

namespace [[gnu::visibility("default")]] pcl_bv {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// What one rounding to double is off by at most, relatively: the U of what is said about errors.
inline constexpr double kU = 0x1p-53;

/// Added to a bound, it covers what underflow takes from a few products.
inline constexpr double kSmallestNormal = std::numeric_limits<double>::min();

}  // namespace pcl_bv
