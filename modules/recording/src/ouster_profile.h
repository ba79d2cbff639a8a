// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The layouts of Ouster's lidar packets, from the firmware user manual and the sensor SDK
// (docs/references.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace pcl_bv::detail {

/// Positions of one return in a channel's data, in bytes.
struct OusterReturn {
  std::size_t range = 0, reflectivity = 0, signal = 0;
};

/// A profile (udp_profile_lidar). A packet has a header, columns and a footer. A column has a header, one
/// block of channel data for each beam, and a footer. Numbers are little-endian. A column's header begins
/// with the timestamp (8 bytes, nanoseconds) and the measurement id (2 bytes).
struct OusterProfile {
  std::string_view name;
  std::size_t packet_header = 32, column_header = 12, channel = 0, column_footer = 0, packet_footer = 32;
  std::uint32_t range_mask = 0;     ///< Bits of the range in its 4 bytes, or in 2 if the mask fits.
  std::uint32_t range_unit_mm = 1;  ///< Millimetres per unit of the range.
  std::size_t reflectivity_bytes = 1;
  bool has_signal = true;
  std::size_t returns = 1;
  OusterReturn at[2]{};

  /// In LEGACY packets, the frame id is in the columns' headers, and the column's status is its footer.
  constexpr bool is_legacy() const { return packet_header == 0; }
  constexpr std::size_t column_size(std::size_t beams) const {
    return column_header + beams * channel + column_footer;
  }
  constexpr std::size_t packet_size(std::size_t beams, std::size_t columns) const {
    return packet_header + columns * column_size(beams) + packet_footer;
  }
};

inline constexpr OusterProfile kOusterLegacy{"LEGACY", 0, 16, 12,   4, 0,
                                             0xFFFFF,  1, 2,  true, 1, {{0, 4, 6}, {}}};
inline constexpr OusterProfile kOusterSingle{
    "RNG19_RFL8_SIG16_NIR16", 32, 12, 12, 0, 32, 0x7FFFF, 1, 1, true, 1, {{0, 4, 6}, {}}};
inline constexpr OusterProfile kOusterDual{
    "RNG19_RFL8_SIG16_NIR16_DUAL", 32, 12, 16, 0, 32, 0x7FFFF, 1, 1, true, 2, {{0, 3, 8}, {4, 7, 10}}};
inline constexpr OusterProfile kOusterLowRate{"RNG15_RFL8_NIR8", 32, 12, 4, 0, 32, 0x7FFF, 8, 1, false, 1,
                                              {{0, 2, 0}, {}}};
inline constexpr const OusterProfile* kOusterProfiles[] = {&kOusterLegacy, &kOusterSingle, &kOusterDual,
                                                           &kOusterLowRate};

}  // namespace pcl_bv::detail
