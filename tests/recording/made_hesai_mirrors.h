// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The angle correction file of an AT128, and the directions that it stands for.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "made_packets.h"

namespace pcl_bv {

/// Numbers of the file, in units of 2/25600 degree, and of the corrections, in units of 2/100 degree.
inline int mirror_start(std::size_t mirror) {
  return 298'639 + 1'536'000 * static_cast<int>(mirror);
}
inline int mirror_azimuth(std::size_t channel) {
  return -30'720 + 8'320 * static_cast<int>(channel % 7);
}
inline int mirror_elevation(std::size_t channel) {
  return -160'000 + 2'500 * static_cast<int>(channel);
}
inline int mirror_correction(std::size_t channel, std::size_t step, bool of_azimuth) {
  return static_cast<int>((channel * 7 + step * (of_azimuth ? 3 : 5)) % 41) - 20;
}

inline std::string mirror_file() {
  const auto number = [](int value) { return bytes_of(static_cast<std::uint32_t>(value), 4); };
  std::string file = "\xEE\xFF\x01\x05\x80\x03\x03\x01\x02\x04" + std::string(5, '\0') + "\x02";
  for (std::size_t i = 0; i < 6; ++i)
    file += number(mirror_start(i < 3 ? i : (i + 1) % 3));
  for (std::size_t i = 0; i < 128; ++i)
    file += number(mirror_azimuth(i));
  for (std::size_t i = 0; i < 128; ++i)
    file += number(mirror_elevation(i));
  for (const bool of_azimuth : {true, false}) {
    for (std::size_t i = 0; i < 128 * 180; ++i)
      file += static_cast<char>(mirror_correction(i / 180, i % 180, of_azimuth));
  }
  return file + std::string(32, '\x5A');
}

/// Azimuth and elevation of a channel in degrees, with the rotor at `rotor` degrees.
inline std::pair<double, double> mirrored(double rotor, std::size_t channel) {
  const auto degrees = [](int number) { return number * 2 / 25'600.0; };
  double start = degrees(mirror_start(2)) - 360;
  for (std::size_t i = 0; i < 3; ++i) {
    if (rotor >= degrees(mirror_start(i))) start = degrees(mirror_start(i));
  }
  const auto step = static_cast<std::size_t>(rotor / 2);
  const double part = rotor / 2 - static_cast<double>(step);
  const auto correction = [&](bool of_azimuth) {
    return 0.02 * ((1 - part) * mirror_correction(channel, step, of_azimuth) +
                   part * mirror_correction(channel, (step + 1) % 180, of_azimuth));
  };
  return {2 * (rotor - start) - degrees(mirror_azimuth(channel)) + correction(true),
          degrees(mirror_elevation(channel)) + correction(false)};
}

}  // namespace pcl_bv
