// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Exact values of n . p for any direction n: what decides where a slab of a user's own direction lies.
#pragma once

#include <array>

#include "pcl_bv/numeric/coordinates.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// A direction of any length.
using Direction = std::array<double, 3>;

/// -1, 0 or 1: the sign of n . p - n . q, exactly, whatever over- or underflows in between. Where plain
/// doubles with a rigorous bound can tell they do; else expansions, and rationals where these are not exact.
/// All components up to 1e150 in magnitude.
int compare_along(const Direction& n, const Coordinates& p, const Coordinates& q);

/// The greatest double <= and the least double >= the exact n . p; equal if it is a double itself. Never -0.
/// All components up to 1e150 in magnitude.
double project_down(const Direction& n, const Coordinates& p);
double project_up(const Direction& n, const Coordinates& p);

}  // namespace pcl_bv
