// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Packets as a Hesai would send, written from the manuals of the PandarXT, Pandar64 and Pandar40.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "made_packets.h"

namespace pcl_bv {

/// A sensor: 32 and 16 channels are those of a PandarXT.
struct MadeHesai {
  std::size_t channels = 32;
  bool dual = false;
  bool sequence = true;  ///< Whether packets have a sequence number.
  int step = 18;         ///< Rotation between two firings, hundredths of a degree; negative: backwards.

  bool xt() const { return channels <= 32; }
  std::size_t blocks() const { return xt() ? 8 : channels == 64 ? 6 : 10; }
  std::size_t firings() const { return dual ? blocks() / 2 : blocks(); }
  double period_us() const { return xt() ? 50 : 55.56; }
};

/// Distance in units of 4 mm and reflectivity. A distance of 0 is no return.
using MadeHesaiReturn = std::pair<unsigned, unsigned>;

/// The returns of each channel, for each firing.
struct MadeHesaiPacket {
  unsigned azimuth = 0, microseconds = 0;
  std::vector<std::vector<std::array<MadeHesaiReturn, 2>>> firings{};
};

inline unsigned firing_azimuth(const MadeHesai& s, unsigned first, std::size_t firing) {
  return static_cast<unsigned>(static_cast<int>(first) + 36'000 + s.step * static_cast<int>(firing)) % 36'000;
}

/// A packet with random returns, of which one in four is missing and one dual return in eight is repeated.
inline MadeHesaiPacket random_hesai(const MadeHesai& s, unsigned azimuth, unsigned us, unsigned seed) {
  std::mt19937 random(seed);
  MadeHesaiPacket made{azimuth, us, {}};
  for (std::size_t f = 0; f < s.firings(); ++f) {
    auto& firing = made.firings.emplace_back(s.channels);
    for (auto& returns : firing) {
      for (auto& [distance, reflectivity] : returns) {
        distance = random() % 4 == 0 ? 0 : static_cast<unsigned>(random()) % 65'536;
        reflectivity = static_cast<unsigned>(random()) % 256;
      }
      if (random() % 8 == 0) returns[1] = returns[0];
    }
  }
  return made;
}

/// Packets of a revolution after the other from azimuth `first` on.
inline std::vector<MadeHesaiPacket> hesai_packets(const MadeHesai& s, std::size_t number, unsigned first,
                                                  unsigned seed, unsigned us = 999'000) {
  std::vector<MadeHesaiPacket> packets;
  for (std::size_t i = 0; i < number; ++i) {
    const std::size_t firing = i * s.firings();
    const auto passed = static_cast<unsigned>(static_cast<double>(firing) * s.period_us());
    packets.push_back(random_hesai(s, firing_azimuth(s, first, firing % 36'000), (us + passed) % 1'000'000,
                                   seed + static_cast<unsigned>(i)));
  }
  return packets;
}

inline std::string hesai_bytes(const MadeHesai& s, const MadeHesaiPacket& made) {
  const std::size_t mode = s.dual ? 0x39 : 0x37;
  std::string bytes;
  if (s.xt())
    bytes = "\xEE\xFF\x06\x01" + std::string(2, '\0') + bytes_of(s.channels, 1) + bytes_of(8, 1) +
            bytes_of(s.dual ? 1 : 0, 1) + bytes_of(4, 1) + bytes_of(s.dual ? 2 : 1, 1) +
            bytes_of(s.sequence ? 1 : 0, 1);
  if (s.channels == 64)
    bytes = "\xEE\xFF\x40\x06" + bytes_of(s.dual ? 1 : 0, 1) + bytes_of(4, 1) + bytes_of(0, 2);
  for (std::size_t block = 0; block < s.blocks(); ++block) {
    const std::size_t firing = s.dual ? block / 2 : block;
    if (s.channels == 40) bytes += "\xFF\xEE";
    bytes += bytes_of(firing_azimuth(s, made.azimuth, firing), 2);
    for (const auto& returns : made.firings[firing]) {
      const auto& [distance, reflectivity] = returns[s.dual ? block % 2 : 0];
      bytes += bytes_of(distance, 2) + bytes_of(reflectivity, 1) + (s.xt() ? "\x5A" : "");
    }
  }
  const int turn = s.step < 0 ? -s.step : s.step;
  const auto rpm = static_cast<std::uint64_t>(turn / 36e3 / s.period_us() * 60e6 + 0.5);
  const std::string date = std::string("\x7D\x01\x02\x03\x04\x05", 6);
  if (s.xt()) {
    bytes += std::string(9, '\x5A') + bytes_of(0, 1) + bytes_of(mode, 1) + bytes_of(rpm, 2) + date +
             bytes_of(made.microseconds, 4) + bytes_of(0x42, 1);
  } else {
    bytes += std::string(5, '\x5A') + bytes_of(0, 3) + bytes_of(rpm, 2) + bytes_of(made.microseconds, 4) +
             bytes_of(mode, 1) + bytes_of(0x42, 1) + date;
  }
  return s.sequence ? bytes + bytes_of(7, 4) : bytes;
}

/// The angles in the correction file: elevation and azimuth of each channel in thousandths of a degree.
inline std::vector<std::pair<int, int>> hesai_angles(std::size_t channels) {
  std::vector<std::pair<int, int>> angles;
  for (int i = 0; i < static_cast<int>(channels); ++i)
    angles.emplace_back(15'210 - (channels > 64 ? 297 : 997) * i, -5'208 + 1'042 * (i % 11));
  return angles;
}

inline std::string hesai_correction(std::size_t channels) {
  std::string csv = "Laser id,Elevation,Azimuth\r\n";
  int number = 0;
  const auto text = [](int thousandths) {
    const std::string digits = std::to_string(std::abs(thousandths) % 1'000 + 1'000).substr(1);
    return (thousandths < 0 ? "-" : "") + std::to_string(std::abs(thousandths) / 1'000) + "." + digits;
  };
  for (const auto& [elevation, azimuth] : hesai_angles(channels))
    csv += std::to_string(++number) + "," + text(elevation) + "," + text(azimuth) + "\r\n";
  return csv + "4d186cf2\n";
}

}  // namespace pcl_bv
