// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Numbers in the packets of all sensors.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstring>
#include <vector>

namespace pcl_bv::detail {

/// Reads a little-endian number. The host is little-endian, as elsewhere in this module.
template <class T>
T little_endian(const std::byte* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

/// Packets have angles in hundredths of a degree.
inline constexpr std::size_t kFullCircle = 36'000;

struct SineCosine {
  double sine, cosine;
};

/// Returns the sine and cosine of each hundredth of a degree, kFullCircle of them.
inline const std::vector<SineCosine>& sine_cosine_table() {
  static const auto all = [] {
    constexpr double degree = 3.14159265358979323846 / 180;
    std::vector<SineCosine> table(kFullCircle);
    for (std::size_t i = 0; i < kFullCircle; ++i) {
      const double angle = static_cast<double>(i) / 100 * degree;
      table[i] = {std::sin(angle), std::cos(angle)};
    }
    return table;
  }();
  return all;
}

/// Returns the sine and cosine of an angle in hundredths of a degree, with an error below 1e-11.
inline SineCosine sine_cosine_of(double angle) {
  constexpr double degree = 3.14159265358979323846 / 180;
  constexpr auto circle = static_cast<long long>(kFullCircle);
  const double whole = std::floor(angle);
  const long long index = static_cast<long long>(whole) % circle;
  const auto [s, c] = sine_cosine_table()[static_cast<std::size_t>(index < 0 ? index + circle : index)];
  if (whole == angle) return {s, c};
  const double rest = (angle - whole) / 100 * degree, cosine = 1 - rest * rest / 2;
  return {s * cosine + c * rest, c * cosine - s * rest};
}

/// Returns the signed difference of two azimuths in hundredths of a degree, from -18000 to 18000.
inline double azimuth_difference(double from, double to) {
  return std::remainder(to - from, static_cast<double>(kFullCircle));
}

/// Returns the rotation between two firings in the direction of rotation, which is 1 or -1. It is less than a
/// revolution, also where the azimuth leaps over the gap of a limited field of view. The azimuth may go back
/// by half a degree, as that of a rotor that stands still does.
inline double rotation_along(double from, double to, double direction) {
  constexpr double jitter = 50;
  const double difference = azimuth_difference(from, to);
  return direction * difference < -jitter ? difference + direction * static_cast<double>(kFullCircle)
                                          : difference;
}

}  // namespace pcl_bv::detail
