// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The metadata of an Ouster sensor, without which its packets cannot be decoded.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "ouster_profile.h"

namespace pcl_bv::detail {

struct OusterMetadata {
  std::string model;  ///< Product line, such as "OS-1-64".
  /// Serial number, initialization id and destination port of the packets; 0 if unknown.
  std::uint64_t serial = 0, init_id = 0, port = 0;
  const OusterProfile* profile = nullptr;
  std::size_t beams = 0, columns_per_packet = 0, columns_per_frame = 0;
  std::vector<double> altitudes, azimuths;  ///< Angles of each beam, degrees.
  /// Position of the beams' origin in the rotating frame of the lidar, millimetres: entries (0,3) and (2,3)
  /// of beam_to_lidar_transform.
  double beam_x_mm = 0, beam_z_mm = 0;
  std::array<double, 16> lidar_to_sensor{};  ///< Row by row, millimetres.

  std::size_t packet_size() const { return profile->packet_size(beams, columns_per_packet); }
};

/// Parses metadata, either the flat layout of earlier firmware or the nested layout (`beam_intrinsics`,
/// `lidar_data_format`, ...). Metadata of firmware 1.12 and 1.13 lacks the packet format and the beams'
/// origin; both then are as in Ouster's SDK. Throws IoError for JSON that is not such metadata, for values
/// out of range and for profiles that are not supported.
OusterMetadata parse_ouster_metadata(std::string_view json);

}  // namespace pcl_bv::detail
