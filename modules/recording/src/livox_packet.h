// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The layout of the point packets of Livox' Mid-360 and HAP, from Livox' communication protocols
// (docs/references.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "udp_payload.h"

namespace pcl_bv::detail {

inline constexpr std::size_t kLivoxHeader = 36;

/// A packet has a header and points. The time of the points advances evenly from `first_time_ns` to
/// `first_time_ns` + `duration_ns`. Numbers are little-endian.
struct LivoxPacket {
  std::uint8_t data_type = 0;       ///< 1: millimetres, 2: centimetres, 3: spherical coordinates.
  std::size_t points = 0;           ///< Number of points, at least 1.
  std::uint64_t first_time_ns = 0;  ///< Time of the first point by the sensor's clock.
  std::uint64_t duration_ns = 0;    ///< Time from the first point to the last one.
  std::uint32_t checksum = 0;       ///< CRC-32 of the bytes from kLivoxChecked to the end.
};

inline constexpr std::size_t kLivoxChecked = 28;  ///< Position of the first byte that the checksum covers.

/// Returns the size of a point of this data type in bytes, or 0 for types that have no points or are not
/// documented for these sensors.
constexpr std::size_t livox_point_size(std::uint8_t data_type) {
  return data_type == 1 ? 14 : data_type == 2 ? 8 : data_type == 3 ? 10 : 0;
}

/// Returns whether the packet has the header of Livox' protocol, with points or without: the version is 0,
/// the length is that of the packet, and the time is of a known type.
inline bool has_livox_header(const Payload& packet) {
  if (packet.size <= kLivoxHeader || packet.data[0] != std::byte{0}) return false;
  std::uint16_t length;
  std::memcpy(&length, packet.data + 1, sizeof length);
  return length == packet.size && packet.data[11] <= std::byte{2};
}

/// Reads the header. Returns false if the packet is not a point packet with a documented layout.
inline bool read_livox_packet(const Payload& packet, LivoxPacket& read) {
  if (!has_livox_header(packet)) return false;
  std::uint16_t interval, points;  // the interval is in units of 0.1 us
  std::memcpy(&interval, packet.data + 3, sizeof interval);
  std::memcpy(&points, packet.data + 5, sizeof points);
  read.data_type = std::to_integer<std::uint8_t>(packet.data[10]);
  read.points = points;
  read.duration_ns = std::uint64_t{100} * interval;
  std::memcpy(&read.checksum, packet.data + 24, sizeof read.checksum);
  std::memcpy(&read.first_time_ns, packet.data + 28, sizeof read.first_time_ns);
  const std::size_t point = livox_point_size(read.data_type);
  return point > 0 && points > 0 && packet.size == kLivoxHeader + points * point;
}

}  // namespace pcl_bv::detail
