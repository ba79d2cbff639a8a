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

/// A model. A packet has a header, blocks and a tail. A block has the azimuth of the rotor (in the last two
/// bytes of its header, hundredths of a degree) and a return of each channel: distance (2 bytes, 4 mm) and
/// reflectivity (1 byte). With dual returns, two adjacent blocks have the two returns of one firing. Numbers
/// are little-endian.
struct HesaiModel {
  std::string_view name;
  std::size_t channels = 0, blocks = 0;
  std::size_t header = 0, block_header = 0, channel = 0, tail = 0;  ///< Sizes in bytes.
  std::size_t return_mode = 0, motor_speed = 0, timestamp = 0;      ///< Positions in the tail.
  std::int64_t firing_ns = 0;                                       ///< Time between two firings.
  bool has_published_angles = false;  ///< Without them, the sensor's correction file is needed.

  constexpr std::size_t block_size() const { return block_header + channels * channel; }
  constexpr std::size_t tail_at() const { return header + blocks * block_size(); }
  /// Returns the size of a packet without the sequence number, which has 4 further bytes.
  constexpr std::size_t packet_size() const { return tail_at() + tail; }

  const std::byte* block(const Payload& packet, std::size_t index) const {
    return packet.data + header + index * block_size();
  }
  int azimuth(const Payload& packet, std::size_t index) const {
    std::uint16_t value;
    std::memcpy(&value, block(packet, index) + block_header - 2, sizeof value);
    return value;
  }
  /// Returns the number of blocks for each firing: 2 with dual returns, 1 with single ones, 0 for modes that
  /// are not supported.
  std::size_t blocks_per_firing(const Payload& packet) const;
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
