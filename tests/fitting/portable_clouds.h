// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clouds that no machine computes otherwise: for comparing bits of results between processors and with those
// of yesterday.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "clouds.h"

namespace pcl_bv::test {

/// Only the generator's integers, sums, products, quotients and roots: std::normal_distribution takes
/// logarithms, which libraries round differently.
class Portable {
 public:
  explicit Portable(std::uint64_t seed) : random_(seed) {}

  /// A multiple of 2^-24 in (-2, 2), near 0 mostly.
  double bell() {
    double sum = -2;
    for (int i = 0; i < 4; ++i)
      sum += static_cast<double>(random_() >> 40) * 0x1p-24;
    return sum;
  }

  template <typename T>
  std::vector<T> ball(std::size_t n, double scale, double offset) {
    std::vector<T> xyz;
    while (xyz.size() < 3 * n)
      xyz.push_back(static_cast<T>(offset + scale * bell()));
    return xyz;
  }

  template <typename T>
  std::vector<T> sphere(std::size_t n) {
    std::vector<T> xyz;
    while (xyz.size() < 3 * n) {
      const double x = bell(), y = bell(), z = bell() + 0x1p-30;
      const double length = std::sqrt(x * x + y * y + z * z);
      for (const double c : {x, y, z})
        xyz.push_back(static_cast<T>(c / length));
    }
    return xyz;
  }

 private:
  std::mt19937_64 random_;
};

/// Of one point to several chunks, of all magnitudes that methods tell apart, flat and with holes.
template <typename T>
std::vector<TestCloud<T>> portable_clouds() {
  std::vector<TestCloud<T>> all;
  for (const std::size_t n : {1, 2, 3, 4, 5, 17, 300, 1025, 5000}) {
    Portable random(n);
    all.push_back({"ball of " + std::to_string(n), random.ball<T>(n, 1, 0)});
    all.push_back({"sphere of " + std::to_string(n), random.sphere<T>(n)});
  }
  Portable random(1);
  all.push_back({"ball of several chunks", random.ball<T>(70'000, 1, 0)});
  all.push_back({"UTM size", random.ball<T>(3000, 20, 5e6)});
  all.push_back({"a millimetre at 1", random.ball<T>(3000, 1e-3, 1)});
  all.push_back({"scale 1e-41", random.ball<T>(3000, 1e-41, 0)});
  all.push_back({"scale 1e-20", random.ball<T>(3000, 1e-20, 0)});
  all.push_back({"scale 1e20", random.ball<T>(3000, 1e20, 0)});
  all.push_back({"scale 1e37", random.ball<T>(3000, 1e37, 0)});
  TestCloud<T> flat{"tilted plane", random.ball<T>(3000, 1, 0)}, holed{"NaN", random.ball<T>(3000, 1, 0)};
  for (std::size_t i = 0; i < 3000; ++i) {
    flat.xyz[3 * i + 2] = flat.xyz[3 * i];
    if (i % 7 == 3) holed.xyz[3 * i + i % 3] = std::numeric_limits<T>::quiet_NaN();
  }
  all.insert(all.end(), {flat, holed});
  return all;
}

}  // namespace pcl_bv::test
