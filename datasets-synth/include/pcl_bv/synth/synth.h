// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Scenes by name, as commands and tests ask for them: NAME[:POINTS[:SEED]].
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "pcl_bv/synth/synth_cloud.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// A scene, fully settled: `points` is exactly the number of points that make_synth gives.
struct SynthSpec {
  std::string name;
  std::size_t points = 0;
  std::uint64_t seed = 1;
};

/// Reads NAME[:POINTS[:SEED]].
///
/// Names and default points: `street` 128000 (street.h); `sphere`, `box`, `gauss`, `surface` 100000
/// (shapes.h); `paper-4010`, `paper-7260`, `paper-30892`, `paper-32875`, `paper-48485`, `paper-100722`,
/// `paper-327323`: that many points on a bumpy closed surface (make_surface with the number of points as its
/// shape), standing in for the meshes of Table 1 of Karlsson, Winberg and Larsson 2010. POINTS is 1 to
/// 2000000000; for street it counts rays and is rounded to the nearest multiple of 64, at least 64 (half-way:
/// up). SEED is any 64-bit number, default 1.
///
/// Throws std::invalid_argument, naming the value and what is allowed, for anything else, also for POINTS
/// that differ from a paper scene's own.
SynthSpec parse_synth(std::string_view text);

/// Makes the scene. Throws std::invalid_argument for a name that parse_synth does not know.
SynthCloud make_synth(const SynthSpec& spec);

/// The names that parse_synth knows, comma-separated, for help texts.
std::string synth_names();

/// A run of street sweeps, frame 0 to frames - 1 (street.h).
struct StreetSequenceSpec {
  std::size_t frames = 22;
  std::uint64_t seed = 1;
};

/// Reads `street-sequence[:FRAMES[:SEED]]`, FRAMES 1 to 1000000. Throws std::invalid_argument like
/// parse_synth.
StreetSequenceSpec parse_street_sequence(std::string_view text);

}  // namespace pcl_bv
