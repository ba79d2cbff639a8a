// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Polar cells around the sensor, in rings of 0.5 m with 256 sectors each. The cells are fine enough that the
// foot of a wall is in the same cell as the wall above it. They are coarse enough that one or two beams above
// the foot hit the same cell.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

namespace pcl_bv::detail {

inline constexpr std::size_t sector_count = 256;  ///< Sector 0 begins at the u axis.
/// Number of rings. The last ring has no outer limit. It holds all points at 100 m or farther.
inline constexpr std::size_t ring_count = 201;
inline constexpr std::size_t cell_count = ring_count * sector_count;  ///< Cells are numbered ring by ring.
inline constexpr float ring_width = 0.5F;                             ///< Metres.

/// Returns the distance of a point from the centre, metres.
inline float range_of(float u, float v) {
  return std::sqrt(u * u + v * v);
}

/// Returns the angle of a point in turns, from 0 to 1, accurate to 0.004 rad. The result is the same on every
/// machine, unlike that of atan2() of the C libraries.
inline float angle_in_turns(float u, float v) {
  const float along = std::abs(u), across = std::abs(v);
  const float longer = std::max(along, across);
  const float t = std::min(along, across) / (longer > 0 ? longer : 1);
  float turn = t * (0.125F + 0.04345F * (1 - t));  // atan(t) in turns
  turn = across > along ? 0.25F - turn : turn;
  turn = u < 0 ? 0.5F - turn : turn;
  return v < 0 ? 1 - turn : turn;
}

/// Returns the index of the cell with the given range and angle. The angle is in turns; 1 is the same as 0.
inline std::int32_t cell_of(float range, float turn) {
  const auto ring = static_cast<std::int32_t>(std::min(range / ring_width, float{ring_count - 1}));
  const auto sector = static_cast<std::int32_t>(turn * float{sector_count});
  return ring * std::int32_t{sector_count} + (sector & std::int32_t{sector_count - 1});
}

/// Returns the distance of the middle of a ring from the centre, metres.
constexpr float middle_of(std::size_t ring) {
  return ring_width * (static_cast<float>(ring) + 0.5F);
}

/// Returns the width of a sector in the middle of a ring, metres.
constexpr float width_of(std::size_t ring) {
  return middle_of(ring) * static_cast<float>(2 * std::numbers::pi / sector_count);
}

struct Direction {
  double u, v;
};

/// Unit vectors to the middle of the sectors. They are computed by Taylor series to 1e-8, because the results
/// of C libraries differ.
inline constexpr std::array<Direction, sector_count> sector_directions = [] {
  std::array<Direction, sector_count> all{};
  for (std::size_t s = 0; s < sector_count; ++s) {
    const double turns = (static_cast<double>(s) + 0.5) / sector_count;
    const double x = 2 * std::numbers::pi * (turns > 0.5 ? turns - 1 : turns);
    double term = 1;
    for (int i = 0; i < 24; i += 2) {
      all[s].u += term;
      term *= x / (i + 1);
      all[s].v += term;
      term *= -x / (i + 2);
    }
  }
  return all;
}();

/// A value for each cell of a ring. A copy of the last value is stored before the first value, and a copy of
/// the first value after the last value.
struct RingRow : std::array<float, sector_count + 2> {
  void copy(const float* cells) {
    std::copy_n(cells, sector_count, data() + 1);
    close();
  }
  void close() {
    front() = (*this)[sector_count];
    back() = (*this)[1];
  }
};

}  // namespace pcl_bv::detail
