// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The layout of Velodyne's point packets, from the manuals of the sensors (docs/references.md). Angles are in
// hundredths of a degree.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "packet_numbers.h"
#include "udp_payload.h"

namespace pcl_bv::detail {

inline constexpr std::size_t kVelodynePacket = 1206, kVelodyneBlocks = 12, kVelodyneLasers = 32;
inline constexpr double kRevolution = kFullCircle;

/// A model. A block has the azimuth of the rotor and 32 returns. A VLP-16 fires its 16 beams twice for each
/// block, one after the other. The azimuth is that of the first laser.
struct VelodyneModel {
  std::string_view name;
  std::uint8_t product_id;  ///< The last byte of a packet.
  std::size_t beams;
  double distance_unit;                                ///< Metres.
  double block_ns;                                     ///< Time between blocks with different azimuths.
  double laser_ns;                                     ///< Time between lasers that fire successively.
  std::size_t lasers_at_once;                          ///< Number of adjacent lasers that fire together.
  std::array<double, kVelodyneLasers> elevation;       ///< Of each beam, degrees.
  std::array<double, kVelodyneLasers> azimuth_offset;  ///< Of each beam, degrees.

  /// Returns the time between the first laser of a block and this laser, nanoseconds.
  double laser_time(std::size_t laser) const {
    const double sequence_ns = block_ns * static_cast<double>(beams) / kVelodyneLasers;
    return static_cast<double>(laser / beams) * sequence_ns +
           static_cast<double>(laser % beams / lasers_at_once) * laser_ns;
  }
};

/// Returns the model of the sensor that sent the packet, or null if the packet is not of a supported model.
const VelodyneModel* velodyne_model(const Payload& packet);

/// Returns the number of the model in the list of models, and the model with this number.
std::size_t index_of(const VelodyneModel& model);
const VelodyneModel& velodyne_model(std::size_t index);

/// Returns the product id (last byte) of a Velodyne packet, or -1 for other packets.
int velodyne_product(const Payload& packet);

/// Returns the sensor's time of the packet's first firing, microseconds of the hour.
inline std::uint32_t velodyne_clock(const Payload& packet) {
  return little_endian<std::uint32_t>(packet.data + kVelodynePacket - 6);
}

/// Returns the return of a laser: distance (2 bytes) and reflectivity (1 byte).
inline const std::byte* velodyne_return(const Payload& packet, std::size_t block, std::size_t laser) {
  constexpr std::size_t block_size = 100, header = 4;
  return packet.data + block_size * block + header + 3 * laser;
}

/// The rotation of the sensor within a packet. A firing is one block or, with dual returns, two blocks. A
/// sensor with a limited field of view sends the first firing of the field right after the last one: the
/// azimuth leaps over the gap.
struct VelodyneFirings {
  explicit VelodyneFirings(const Payload& packet);

  std::size_t blocks = 1;  ///< Of each firing.
  std::size_t count = 0;   ///< Number of firings.
  /// Median rotation from a firing to the next one, negative if azimuths decrease.
  double step = 0;
  std::array<double, kVelodyneBlocks> azimuth{};   ///< Of each firing, as in the packet.
  std::array<double, kVelodyneBlocks> rotation{};  ///< From the first firing to each firing, with leaps.
  /// Rotation in the time until the next firing. At the packet's end and before a leap, it is that of the
  /// firing before.
  std::array<double, kVelodyneBlocks> advance{};
  /// Rotation over the gap before each firing, beyond a normal step. 0 without a leap.
  std::array<double, kVelodyneBlocks> leap{};
  double leaps = 0;  ///< Sum of `leap`.

  /// Returns the maximum rotation between successive firings. Normal steps differ by a few hundredths of a
  /// degree.
  static double max_step(double step) { return 1.5 * std::abs(step) + 10; }
  /// Returns the rotation from the first to the last firing.
  double total() const { return rotation[count - 1]; }

 private:
  void ignore_leaps();
};

}  // namespace pcl_bv::detail
