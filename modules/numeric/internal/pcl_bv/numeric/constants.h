// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <limits>

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Largest relative error of one rounding to double (unit roundoff). The error bounds in docs/numerics.md
/// call this number U.
inline constexpr double kUnitRoundoff = 0x1p-53;

/// Smallest normal positive double. Added to an error bound, it covers the underflow of a few products.
inline constexpr double kSmallestNormal = std::numeric_limits<double>::min();

}  // namespace detail
}  // namespace pcl_bv
