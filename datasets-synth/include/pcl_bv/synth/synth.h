// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Synthetic scenes selected by a text such as NAME[:POINTS[:SEED]].
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "pcl_bv/synth/rural_road.h"
#include "pcl_bv/synth/synth_cloud.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// A scene with all defaults filled in. `points` is exactly the number of points that make_synth() returns.
struct SynthOptions {
  std::string name;
  std::size_t points = 0;
  std::uint64_t seed = 1;
};

/// Parses NAME[:POINTS[:SEED]].
///
/// Names and their default POINTS:
///
/// - `street` 128000 (street.h);
/// - `sphere`, `box`, `gauss`, `surface` 100000 (shapes.h);
/// - `rural-road` 128000, `rural-road-16` 28800, `rural-road-32` 57600, `rural-road-128` 230400: frame 0 of
///   the rural road (rural_road.h) for a sensor with 64, 16, 32 or 128 beams;
/// - `paper-4010`, `paper-7260`, `paper-30892`, `paper-32875`, `paper-48485`, `paper-100722`, `paper-327323`:
///   the number of points in the name, on a bumpy closed surface (make_surface() with the number of points
///   as the argument `shape`). They replace the meshes of Table 1 of Karlsson, Winberg and Larsson 2010.
///
/// POINTS is 1 to 2000000000. For `street` POINTS is the number of rays, rounded to the nearest multiple of
/// 64 (half-way cases round up), at least 64. SEED is any unsigned 64-bit number, default 1.
///
/// `verges`, the old name of `rural-road`, is still accepted, also in `verges-16`, `verges-sequence-16`, ...
///
/// Throws std::invalid_argument for any other text. The message gives the value and the allowed values. The
/// scenes `paper-*` and `rural-road*` have a fixed size, so any other POINTS throws.
SynthOptions parse_synth(std::string_view text);

/// Generates the scene. Throws std::invalid_argument for a name that parse_synth() does not know.
SynthCloud make_synth(const SynthOptions& spec);

/// Returns the names that parse_synth() knows, comma-separated, for help texts.
std::string synth_names();

/// A sequence of sweeps of the rural road (rural_road.h): frames 0 to `frames` - 1.
struct RuralRoadSequenceOptions {
  std::size_t frames = 100;
  RuralRoadOptions options;
};

/// Returns whether the text begins with `rural-road-sequence` or its old name `verges-sequence`.
bool is_rural_road_sequence(std::string_view text);

/// Parses `rural-road-sequence[-BEAMS][:FRAMES[:SEED]]`. BEAMS is 16, 32, 64 (default) or 128, FRAMES is 1 to
/// 1000000 (default 100). Throws std::invalid_argument like parse_synth().
RuralRoadSequenceOptions parse_rural_road_sequence(std::string_view text);

/// A sequence of sweeps of the street (street.h): frames 0 to `frames` - 1.
struct StreetSequenceOptions {
  std::size_t frames = 22;
  std::uint64_t seed = 1;
};

/// Parses `street-sequence[:FRAMES[:SEED]]`. FRAMES is 1 to 1000000 (default 22). Throws
/// std::invalid_argument like parse_synth().
StreetSequenceOptions parse_street_sequence(std::string_view text);

}  // namespace pcl_bv
