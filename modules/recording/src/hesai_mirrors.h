// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The angle correction file of a Hesai AT128, which is binary.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

namespace pcl_bv::detail {

/// The mirrors and channels of an AT128. Angles are in hundredths of a degree. While the rotor is between two
/// starts, one mirror deflects the beams. Such a rotation of one mirror is a frame. With the rotor at azimuth
/// a, a channel has the azimuth 2 * (a - start of the frame) - azimuths[channel] + correction, and the
/// elevation elevations[channel] + correction. The corrections depend on a; they are in the tables for
/// multiples of 2 degrees, for each channel 180 numbers.
struct HesaiMirrors {
  std::vector<double> starts;  ///< Azimuths where frames begin, ascending.
  std::vector<double> azimuths, elevations;
  std::vector<double> azimuth_corrections, elevation_corrections;

  static constexpr std::size_t kSteps = 180;

  /// Returns the number of the frame at an azimuth plus whole revolutions. Frames are counted through all
  /// revolutions.
  long long frame_at(double unwrapped) const;
  /// Returns the start of the frame at an azimuth from 0 to 36000.
  double start_of(double azimuth) const;
};

/// Parses a correction file of version 1.5. Throws IoError for other content, a wrong size, and for angles
/// out of range. The file has a header (0xEE 0xFF, version, numbers of channels, mirrors and frames, 8 bytes
/// of settings, and the number r of units of 1/25600 degree in which angles are given), the starts and ends
/// of the mirrors, the azimuths and the elevations of the channels (each 4 bytes), the tables of the
/// corrections (each 1 byte, in r/100 degrees), and a checksum of 32 bytes.
HesaiMirrors parse_hesai_mirrors(std::string_view bytes);

}  // namespace pcl_bv::detail
