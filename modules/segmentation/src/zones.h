// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The patches that the ground is cut into: rings around the sensor, each in sectors.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

namespace pcl_bv {

struct Ring {
  float outer;       ///< Radius, metres; the last ring has no end.
  unsigned sectors;  ///< Their first one begins at the u axis.
};

/// Two to six metres from border to border where beams are dense, up to twelve where they are not.
inline constexpr std::array<Ring, 14> rings{{{3, 16},
                                             {6, 16},
                                             {9, 24},
                                             {12.5F, 32},
                                             {16, 32},
                                             {20, 48},
                                             {25, 48},
                                             {31, 48},
                                             {38, 48},
                                             {46, 48},
                                             {56, 48},
                                             {68, 32},
                                             {80, 32},
                                             {100, 32}}};

/// Number of a ring's first patch; one more at the end.
inline constexpr std::array<std::uint16_t, rings.size() + 1> first_patch = [] {
  std::array<std::uint16_t, rings.size() + 1> first{};
  for (std::size_t i = 0; i < rings.size(); ++i)
    first[i + 1] = static_cast<std::uint16_t>(first[i] + rings[i].sectors);
  return first;
}();

inline constexpr std::size_t patch_count = first_patch.back();

/// The patches at so many half metres from the centre.
struct RingPlace {
  float sectors;
  std::uint16_t first, last;
};

inline constexpr std::array<RingPlace, 161> ring_places = [] {
  std::array<RingPlace, 161> places{};
  std::size_t ring = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    while (ring + 1 < rings.size() && static_cast<float>(i) >= 2 * rings[ring].outer)
      ++ring;
    places[i] = {static_cast<float>(rings[ring].sectors), first_patch[ring],
                 static_cast<std::uint16_t>(first_patch[ring + 1] - 1)};
  }
  return places;
}();

struct PatchCenter {
  double u, v;
};

/// cos and sin of an angle in turns, to 1e-8: Taylor's series from -pi to pi.
constexpr PatchCenter direction(double turns) {
  const double x = 2 * std::numbers::pi * (turns > 0.5 ? turns - 1 : turns);
  double cosine = 0, sine = 0, term = 1;
  for (int i = 0; i < 24; i += 2) {
    cosine += term;
    term *= x / (i + 1);
    sine += term;
    term *= -x / (i + 2);
  }
  return {cosine, sine};
}

inline constexpr std::array<PatchCenter, patch_count> patch_centers = [] {
  std::array<PatchCenter, patch_count> centers{};
  for (std::size_t ring = 0; ring < rings.size(); ++ring) {
    const double radius = 0.5 * ((ring > 0 ? rings[ring - 1].outer : 0.F) + rings[ring].outer);
    for (unsigned sector = 0; sector < rings[ring].sectors; ++sector) {
      const PatchCenter at = direction((sector + 0.5) / rings[ring].sectors);
      centers[first_patch[ring] + sector] = {radius * at.u, radius * at.v};
    }
  }
  return centers;
}();

/// Places are told apart by half metres from the centre and 256ths of a turn: so fine that a wall's foot and
/// what stands on it share a cell, so coarse that a beam or two above the foot meets it, too.
inline constexpr std::size_t cell_rings = 161, cell_sectors = 256;

struct ZonePlace {
  std::uint16_t patch;
  std::uint16_t cell;
};

/// From the centre to a point; 160 from 80 m on.
inline std::int32_t half_metres_of(float u, float v) {
  return static_cast<std::int32_t>(std::min(2 * std::sqrt(u * u + v * v), 160.F));
}

/// Its angle in turns, 0 to 1. It is no libm's, which differ: it is right to 0.004 rad, and the same
/// everywhere.
inline float turn_of(float u, float v) {
  const float along = std::abs(u), across = std::abs(v);
  const float longer = std::max(along, across);
  const float t = std::min(along, across) / (longer > 0 ? longer : 1);
  float turn = t * (0.125F + 0.04345F * (1 - t));  // atan(t) in turns
  turn = across > along ? 0.25F - turn : turn;
  turn = u < 0 ? 0.5F - turn : turn;
  return v < 0 ? 1 - turn : turn;
}

inline ZonePlace place_of(std::int32_t half_metres, float turn) {
  const RingPlace& ring = ring_places[static_cast<std::size_t>(half_metres)];
  const auto patch = ring.first + static_cast<std::int32_t>(turn * ring.sectors);
  const auto sector = static_cast<std::int32_t>(turn * static_cast<float>(cell_sectors)) % cell_sectors;
  return {static_cast<std::uint16_t>(std::min<std::int32_t>(patch, ring.last)),
          static_cast<std::uint16_t>(static_cast<std::size_t>(half_metres) * cell_sectors + sector)};
}

}  // namespace pcl_bv
