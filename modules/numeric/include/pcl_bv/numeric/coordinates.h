// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>

namespace [[gnu::visibility("default")]] pcl_bv {

struct Coordinates {
  double x, y, z;

  double operator[](std::size_t axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
};

/// The same place; -0 is 0, and a NaN is nowhere.
inline bool operator==(const Coordinates& a, const Coordinates& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

/// The greatest magnitude of a coordinate that counts: beyond it squares would leave the range of double.
inline constexpr double kMaxCoordinate = 1e100;

/// Whether a point counts: all three coordinates finite, and at most kMaxCoordinate in magnitude (only a
/// double can exceed that).
inline bool is_valid(const Coordinates& p) {
  constexpr double limit = kMaxCoordinate;
  return p.x >= -limit && p.x <= limit && p.y >= -limit && p.y <= limit && p.z >= -limit && p.z <= limit;
}

}  // namespace pcl_bv
