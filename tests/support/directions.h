// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Directions for tests: those of EPOS-98, seeded ones, and nasty ones.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace pcl_bv::test {

using Directions = std::vector<std::array<double, 3>>;

/// Components 0, +-1, +-2, none a multiple of another: 49.
inline Directions integer_directions() {
  Directions all;
  for (int x = 0; x <= 2; ++x) {
    for (int y = -2; y <= 2; ++y) {
      for (int z = -2; z <= 2; ++z) {
        const bool first_positive = x > 0 || (x == 0 && (y > 0 || (y == 0 && z > 0)));
        const bool reduced = x % 2 != 0 || y % 2 != 0 || z % 2 != 0;
        if (first_positive && reduced) all.push_back({double(x), double(y), double(z)});
      }
    }
  }
  return all;
}

inline Directions random_directions(std::size_t n, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Directions all(n);
  for (auto& d : all)
    d = {normal(random), normal(random), normal(random)};
  return all;
}

/// Magnitudes, cancellations and roundings on which projections go wrong.
inline Directions nasty_directions() {
  return {{1, 1, -1},
          {0.1, 0.2, 0.3},
          {1e-30, 3e-31, -2e-30},
          {1e30, -3e29, 7e29},
          {1e30, 1e-30, 0},
          {1, 1e-20, -1e-20},
          {1, 1e-42, 3e-43},  // denormal floats
          {1, 1e-300, -1e-310},
          {1e30, 1e-305, 1e-310},  // scaled, below the doubles
          {0, -4, 0},
          {1 + 0x1p-52, 1, 0},
          {1.9999999, 1 - 0x1p-53, -1.9999999},
          {1.0 / 3, 1.0 / 3, 1.0 / 3}};
}

}  // namespace pcl_bv::test
