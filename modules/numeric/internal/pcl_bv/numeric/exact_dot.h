// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Exact comparison and directed rounding of projections n . p on any direction n. The slabs of k-DOPs with
// user-defined directions are computed with these functions.
#pragma once

#include <array>

#include "pcl_bv/numeric/coordinates.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// A direction of any length.
using Direction = std::array<double, 3>;

/// Returns the exact sign (-1, 0 or 1) of n . p - n . q, even if intermediate results would overflow or
/// underflow. All components must be at most 1e150 in magnitude.
int compare_along(const Direction& n, const Coordinates& p, const Coordinates& q);

/// Returns the largest double <= n . p or the smallest double >= n . p. Never returns -0. All components must
/// be at most 1e150 in magnitude.
double project_down(const Direction& n, const Coordinates& p);
double project_up(const Direction& n, const Coordinates& p);

}  // namespace detail
}  // namespace pcl_bv
