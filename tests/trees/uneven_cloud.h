// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clouds on which the descriptions of a volume come apart, if they can.
#pragma once

#include <cmath>
#include <random>
#include <string>

#include "clouds.h"

namespace pcl_bv::test {
using namespace detail;

/// Forty points. Axes of sizes from 1e-30 to 1e30 of their own, some flat, a needle or a grid that was
/// squashed, far from the origin, or denormal.
template <typename T>
TestCloud<T> uneven_cloud(int seed) {
  std::mt19937_64 random(static_cast<std::uint64_t>(seed));
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> exponent(-30, 30);
  double scale[3], offset[3] = {0, 0, 0};
  for (double& s : scale)
    s = std::pow(10, exponent(random));
  if (seed % 7 == 1) scale[seed % 3] = 0;
  if (seed % 7 == 2) scale[0] = 1, scale[1] = 1e-12, scale[2] = 1e-14;
  if (seed % 7 == 3)
    scale[0] = 3, scale[1] = 2, scale[2] = 1, offset[0] = 5e5, offset[1] = 5e6, offset[2] = 300;
  if (seed % 7 == 4) scale[seed % 3] = 1e-41;
  const bool is_grid = seed % 7 == 5;
  TestCloud<T> cloud{"seed " + std::to_string(seed), {}};
  for (int i = 0; i < 40; ++i) {
    for (int k = 0; k < 3; ++k) {
      const double at = is_grid ? std::floor(2 * normal(random)) : normal(random);
      cloud.xyz.push_back(static_cast<T>(offset[k] + scale[k] * at));
    }
  }
  return cloud;
}

}  // namespace pcl_bv::test
