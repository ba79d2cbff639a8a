// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The layouts of Hesai's point packets, from the manuals of the sensors and Hesai's SDK (docs/references.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

#include "udp_payload.h"

namespace pcl_bv::detail {

/// What follows the blocks and the tail of a packet.
enum class HesaiTrailer {
  sequence,  ///< Nothing follows the blocks. A sequence number of 4 bytes may follow the tail.
  /// A checksum of 4 bytes follows the blocks. The header's flags tell which of these parts there are:
  /// functional safety (17 bytes, before the tail), sequence number (4), measurements of the inertial sensor
  /// (22) and a signature (32, at the end). A second checksum of 4 bytes precedes the signature.
  flags,
};

/// A model. A packet has a header, blocks and a tail. A block has the azimuth of the rotor (in its header,
/// hundredths of a degree) and a return of each channel: distance (2 bytes) and reflectivity (1 byte).
/// With dual and triple returns, adjacent blocks have the returns of one firing. Numbers are little-endian.
struct HesaiModel {
  std::string_view name;
  std::uint8_t major = 0, minor = 0;  ///< Version of the protocol; 0.0 if the header has none.
  std::size_t channels = 0, blocks = 0;
  std::size_t header = 0, block_header = 0, channel = 0, tail = 0;  ///< Sizes in bytes.
  std::size_t return_mode = 0, motor_speed = 0, timestamp = 0;      ///< Positions in the tail.
  std::int64_t firing_ns = 0;                                       ///< Time between two firings.
  HesaiTrailer trailer = HesaiTrailer::sequence;
  unsigned min_distance = 1;          ///< Smaller numbers are no distances. Some of them are codes.
  bool has_published_angles = false;  ///< Without them, the sensor's correction file is needed.
  unsigned unit_mm = 4;               ///< Millimetres per unit of distance.
  bool has_mirrors = false;           ///< Of an AT128: fine azimuths, and mirrors instead of a rotor.

  constexpr std::size_t block_size() const { return block_header + channels * channel; }
  std::size_t tail_at(const Payload& packet) const;
  /// Returns the size of the packet by its flags. Packets without flags may also have 4 bytes less.
  std::size_t packet_size(const Payload& packet) const;

  const std::byte* block(const Payload& packet, std::size_t index) const {
    return packet.data + header + index * block_size();
  }
  /// Returns the azimuth of a block, hundredths of a degree.
  double azimuth(const Payload& packet, std::size_t index) const {
    std::uint16_t value;
    const std::byte* const at = block(packet, index) + block_header - (has_mirrors ? 3 : 2);
    std::memcpy(&value, at, sizeof value);
    return has_mirrors ? value + std::to_integer<int>(at[2]) / 256.0 : value;
  }
  /// Returns the number of blocks for each firing: 3 with triple returns, 2 with dual ones, 1 with single
  /// ones, 0 for modes that are not supported.
  std::size_t blocks_per_firing(const Payload& packet) const;
  /// Returns the rotation speed in revolutions per minute.
  double rpm(const Payload& packet) const;
};

/// Angles of a channel in degrees. Azimuths are added to the rotor's azimuth, clockwise seen from above.
struct HesaiAngles {
  double elevation = 0, azimuth = 0;
};

/// Returns the model that sent the packet, or null. All of the packet's structure is checked.
const HesaiModel* hesai_model(const Payload& packet);

/// Returns all models.
const std::vector<HesaiModel>& hesai_models();

/// Returns the angles of the channels that the model's manual states. Empty if it states none.
std::vector<HesaiAngles> published_angles(const HesaiModel& model);

/// Returns the time of each channel after the beginning of its firing, nanoseconds.
std::vector<std::int64_t> hesai_firing_times(const HesaiModel& model);

}  // namespace pcl_bv::detail
