// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Packets as a Livox Mid-360 or HAP would send, written from Livox' communication protocol.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "made_packets.h"

namespace pcl_bv {

/// A point in the units of its data type: coordinates, or depth, zenith angle and azimuth.
struct MadeLivoxPoint {
  std::int64_t a = 0, b = 0, c = 0;
  unsigned reflectivity = 0;
};

struct MadeLivoxPacket {
  unsigned type = 1;  ///< Data type.
  std::uint64_t timestamp = 0;
  unsigned interval = 4750;  ///< From the first to the last point, in units of 0.1 us.
  std::vector<MadeLivoxPoint> points{};
};

/// CRC-32 bit by bit.
inline std::uint32_t livox_crc(const std::string& bytes) {
  std::uint32_t crc = 0xFFFFFFFF;
  for (const char byte : bytes) {
    crc ^= static_cast<std::uint8_t>(byte);
    for (int bit = 0; bit < 8; ++bit)
      crc = (crc & 1U) != 0 ? crc >> 1U ^ 0xEDB88320 : crc >> 1U;
  }
  return ~crc;
}

inline std::string livox_point(unsigned type, const MadeLivoxPoint& p, unsigned tag) {
  const auto bits = [](std::int64_t value, std::size_t size) {
    return bytes_of(static_cast<std::uint64_t>(value), size);
  };
  const std::string rest = bytes_of(p.reflectivity, 1) + bytes_of(tag, 1);
  if (type == 3) return bits(p.a, 4) + bits(p.b, 2) + bits(p.c, 2) + rest;
  const std::size_t size = type == 2 ? 2 : 4;
  return bits(p.a, size) + bits(p.b, size) + bits(p.c, size) + rest;
}

inline std::string livox_packet(const MadeLivoxPacket& made) {
  std::string checked = bytes_of(made.timestamp, 8);
  for (const MadeLivoxPoint& point : made.points)
    checked += livox_point(made.type, point, static_cast<unsigned>(point.a) % 64);
  return bytes_of(0, 1) + bytes_of(28 + checked.size(), 2) + bytes_of(made.interval, 2) +
         bytes_of(made.points.size(), 2) + bytes_of(made.timestamp / 480'000 % 208, 2) + bytes_of(0, 1) +
         bytes_of(made.type, 1) + bytes_of(1, 1) + std::string(12, '\x5A') + bytes_of(livox_crc(checked), 4) +
         checked;
}

/// A packet with random points, of which one in eight is no return.
inline MadeLivoxPacket random_livox(unsigned type, std::uint64_t timestamp, unsigned seed,
                                    std::size_t points = 96) {
  std::mt19937 random(seed);
  MadeLivoxPacket made{type, timestamp, 4750, {}};
  const auto number = [&](std::int64_t limit) {
    return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(2 * limit + 1)) - limit;
  };
  const std::int64_t limit = type == 1 ? 200'000 : 32'767;
  for (std::size_t i = 0; i < points; ++i) {
    MadeLivoxPoint point{number(limit), number(limit), number(limit), static_cast<unsigned>(random()) % 256};
    if (type == 3)
      point = {static_cast<std::int64_t>(random() % 200'000), static_cast<std::int64_t>(random() % 18'001),
               static_cast<std::int64_t>(random() % 36'001), point.reflectivity};
    if (random() % 8 == 0) (type == 3 ? point.a : point.a = point.b = point.c) = 0;
    made.points.push_back(point);
  }
  return made;
}

}  // namespace pcl_bv
