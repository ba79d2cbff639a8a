// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Packets and metadata as an Ouster would give, written from its manual.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "made_packets.h"

namespace pcl_bv {

/// One return of a beam. A range of 0 is no return.
struct MadeReturn {
  std::uint32_t range_mm = 0, reflectivity = 0, signal = 0;
};

/// One column: the returns of each beam (two with dual returns).
struct MadeColumn {
  std::uint64_t timestamp = 0;
  unsigned id = 0;
  bool valid = true;
  std::vector<std::array<MadeReturn, 2>> beams{};
};

/// A sensor, and what its metadata say of it.
struct MadeOuster {
  std::string profile = "LEGACY";
  std::size_t beams = 16, columns_per_packet = 16, columns = 64;
  std::vector<double> altitudes{}, azimuths{};
  double beam_x = 15.806, beam_z = 0;
  std::array<double, 16> lidar_to_sensor{-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 36.18, 0, 0, 0, 1};
  std::uint64_t serial = 122'201'000'998;

  bool legacy() const { return profile == "LEGACY"; }
  bool dual() const { return profile == "RNG19_RFL8_SIG16_NIR16_DUAL"; }
  bool low_rate() const { return profile == "RNG15_RFL8_NIR8"; }
};

inline MadeOuster made_ouster(const std::string& profile, std::size_t beams = 16, std::size_t columns = 64) {
  MadeOuster sensor;
  sensor.profile = profile;
  sensor.beams = beams;
  sensor.columns = columns;
  for (std::size_t i = 0; i < beams; ++i) {
    // Six decimals, as in the metadata.
    sensor.altitudes.push_back(
        std::stod(std::to_string(21.5 - 43.0 * static_cast<double>(i) / static_cast<double>(beams))));
    sensor.azimuths.push_back(std::stod(std::to_string(4.23 - 2.81 * static_cast<double>(i % 4))));
  }
  return sensor;
}

inline std::string json_list(const auto& values) {
  std::string text;
  for (const auto value : values)
    text += (text.empty() ? "[" : ", ") + std::to_string(value);
  return text + "]";
}

/// Metadata in the layout of firmware 2.x.
inline std::string flat_metadata(const MadeOuster& s) {
  return "{\"prod_line\": \"OS-1-" + std::to_string(s.beams) + "\", \"prod_sn\": \"" +
         std::to_string(s.serial) +
         "\", \"lidar_mode\": \"1024x10\", \"beam_altitude_angles\": " + json_list(s.altitudes) +
         ", \"beam_azimuth_angles\": " + json_list(s.azimuths) +
         ", \"lidar_origin_to_beam_origin_mm\": " + std::to_string(s.beam_x) +
         ", \"lidar_to_sensor_transform\": " + json_list(s.lidar_to_sensor) +
         ", \"data_format\": {\"pixels_per_column\": " + std::to_string(s.beams) +
         ", \"columns_per_packet\": " + std::to_string(s.columns_per_packet) +
         ", \"columns_per_frame\": " + std::to_string(s.columns) + ", \"udp_profile_lidar\": \"" + s.profile +
         "\"}}\n";
}

/// Metadata in the layout of firmware 3.x.
inline std::string nested_metadata(const MadeOuster& s) {
  const std::array<double, 16> beam_to_lidar{1, 0, 0, s.beam_x, 0, 1, 0, 0, 0, 0, 1, s.beam_z, 0, 0, 0, 1};
  return "{\"sensor_info\": {\"prod_line\": \"OS-0-" + std::to_string(s.beams) + "\", \"prod_sn\": \"" +
         std::to_string(s.serial) +
         "\"},\n \"beam_intrinsics\": {\"beam_altitude_angles\": " + json_list(s.altitudes) +
         ", \"beam_azimuth_angles\": " + json_list(s.azimuths) +
         ", \"beam_to_lidar_transform\": " + json_list(beam_to_lidar) +
         ", \"lidar_origin_to_beam_origin_mm\": " + std::to_string(std::hypot(s.beam_x, s.beam_z)) +
         "},\n \"lidar_intrinsics\": {\"lidar_to_sensor_transform\": " + json_list(s.lidar_to_sensor) +
         "},\n \"lidar_data_format\": {\"pixels_per_column\": " + std::to_string(s.beams) +
         ", \"columns_per_packet\": " + std::to_string(s.columns_per_packet) +
         ", \"columns_per_frame\": " + std::to_string(s.columns) + ", \"udp_profile_lidar\": \"" + s.profile +
         "\"},\n \"config_params\": {\"udp_port_lidar\": 7502, \"lidar_mode\": \"1024x10\"}}\n";
}

/// The channel data of a beam. `noise` fills the bits that have another meaning, such as flags.
inline std::string channel_data(const MadeOuster& s, const std::array<MadeReturn, 2>& beam,
                                std::uint32_t noise) {
  const auto& [one, two] = beam;
  if (s.legacy())
    return bytes_of(one.range_mm | (noise & 0xFFFU) << 20U, 4) + bytes_of(one.reflectivity, 2) +
           bytes_of(one.signal, 2) + bytes_of(noise, 2) + bytes_of(0, 2);
  if (s.low_rate())
    return bytes_of(one.range_mm / 8 | (noise & 1U) << 15U, 2) + bytes_of(one.reflectivity, 1) +
           bytes_of(noise, 1);
  const std::uint32_t flags = (noise & 31U) << 19U;
  if (s.dual())
    return bytes_of(one.range_mm | flags, 3) + bytes_of(one.reflectivity, 1) +
           bytes_of(two.range_mm | flags, 3) + bytes_of(two.reflectivity, 1) + bytes_of(one.signal, 2) +
           bytes_of(two.signal, 2) + bytes_of(noise, 2) + bytes_of(0, 2);
  return bytes_of(one.range_mm | (noise & 0x1FFFU) << 19U, 4) + bytes_of(one.reflectivity, 1) +
         bytes_of(noise, 1) + bytes_of(one.signal, 2) + bytes_of(noise, 2) + bytes_of(0, 2);
}

inline std::string ouster_packet(const MadeOuster& s, unsigned frame,
                                 const std::vector<MadeColumn>& columns) {
  std::string packet;
  if (!s.legacy())
    packet = bytes_of(1, 2) + bytes_of(frame, 2) + bytes_of(0x6C7C36, 3) + bytes_of(s.serial, 5) +
             std::string(20, '\x5A');
  std::uint32_t noise = frame;
  for (const MadeColumn& column : columns) {
    packet += bytes_of(column.timestamp, 8) + bytes_of(column.id, 2);
    packet += s.legacy() ? bytes_of(frame, 2) + bytes_of(88 * column.id, 4)
                         : bytes_of(column.valid ? 0x0001 : 0x1000, 2);
    for (const auto& beam : column.beams)
      packet += channel_data(s, beam, noise = 1'664'525 * noise + 1'013'904'223);
    if (s.legacy()) packet += bytes_of(column.valid ? 0xFFFFFFFF : 0, 4);
  }
  return s.legacy() ? packet : packet + std::string(32, '\xA5');
}

/// All columns of a frame with random returns, of which some are missing.
inline std::vector<MadeColumn> random_columns(const MadeOuster& s, std::uint64_t timestamp, unsigned seed) {
  std::mt19937 random(seed);
  const std::uint32_t largest = s.legacy() ? 0xFFFFF : s.low_rate() ? 0x7FFF * 8 : 0x7FFFF;
  std::vector<MadeColumn> columns(s.columns);
  for (unsigned id = 0; id < s.columns; ++id) {
    columns[id].id = id;
    columns[id].timestamp = timestamp + 97'656 * id;
    for (std::size_t i = 0; i < s.beams; ++i) {
      std::array<MadeReturn, 2>& beam = columns[id].beams.emplace_back();
      for (std::size_t which = 0; which < (s.dual() ? 2U : 1U); ++which) {
        MadeReturn& made = beam[which];
        if (random() % 4 == 0) continue;
        made.range_mm = random() % 8 == 0 ? largest : 1 + static_cast<std::uint32_t>(random()) % largest;
        if (s.low_rate()) made.range_mm = std::max(made.range_mm / 8 * 8, 8U);
        made.reflectivity = static_cast<std::uint32_t>(random()) % (s.legacy() ? 65'536 : 256);
        made.signal = static_cast<std::uint32_t>(random()) % 65'536;
      }
      if (random() % 8 == 0 && s.dual()) beam[1] = beam[0];
    }
  }
  return columns;
}

/// The packets of a frame.
inline std::vector<std::string> packets_of_frame(const MadeOuster& s, unsigned frame,
                                                 const std::vector<MadeColumn>& columns) {
  std::vector<std::string> packets;
  for (auto first = columns.begin(); first != columns.end();
       first += static_cast<std::ptrdiff_t>(s.columns_per_packet))
    packets.push_back(
        ouster_packet(s, frame, {first, first + static_cast<std::ptrdiff_t>(s.columns_per_packet)}));
  return packets;
}

}  // namespace pcl_bv
