// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>

namespace [[gnu::visibility("default")]] pcl_bv {

/// A point or vector in double.
struct Coordinates {
  double x, y, z;

  /// Returns coordinate 0 (x), 1 (y) or 2 (z).
  double operator[](std::size_t axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
};

/// Whether two points have equal coordinates. -0 equals 0; a NaN equals nothing.
inline bool operator==(const Coordinates& a, const Coordinates& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

/// Largest magnitude of a valid coordinate. A product of three valid coordinates does not overflow a double.
inline constexpr double kMaxCoordinate = 1e100;

/// Whether a point is valid: each coordinate is finite and at most kMaxCoordinate in magnitude. A finite
/// float never exceeds that limit.
inline bool is_valid(const Coordinates& p) {
  constexpr double limit = kMaxCoordinate;
  return p.x >= -limit && p.x <= limit && p.y >= -limit && p.y <= limit && p.z >= -limit && p.z <= limit;
}

}  // namespace pcl_bv
