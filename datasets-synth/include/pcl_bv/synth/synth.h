// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Scenes by name, as commands and tests ask for them: NAME[:POINTS[:SEED]].
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "pcl_bv/synth/synth_cloud.h"
#include "pcl_bv/synth/verges.h"

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
/// (shapes.h); `verges` 128000, `verges-16` 28800, `verges-32` 57600, `verges-128` 230400 (frame 0 of
/// verges.h, as seen by that many beams; `verges` by 64); `paper-4010`, `paper-7260`, `paper-30892`,
/// `paper-32875`, `paper-48485`, `paper-100722`, `paper-327323`: that many points on a bumpy closed surface
/// (make_surface with the number of points as its shape), standing in for the meshes of Table 1 of Karlsson,
/// Winberg and Larsson 2010. POINTS is 1 to 2000000000; for street it counts rays and is rounded to the
/// nearest multiple of 64, at least 64 (half-way: up). SEED is any 64-bit number, default 1.
///
/// Throws std::invalid_argument, naming the value and what is allowed, for anything else, also for POINTS
/// that differ from those of a scene of the paper or of the verges.
SynthSpec parse_synth(std::string_view text);

/// Makes the scene. Throws std::invalid_argument for a name that parse_synth does not know.
SynthCloud make_synth(const SynthSpec& spec);

/// The names that parse_synth knows, comma-separated, for help texts.
std::string synth_names();

/// A run of sweeps of the road with verges, frame 0 to frames - 1 (verges.h).
struct VergesSequenceSpec {
  std::size_t frames = 100;
  VergesOptions options;
};

/// Whether a text names such a sequence: up to its first colon, begins with `verges-sequence`.
bool is_verges_sequence(std::string_view text);

/// Reads `verges-sequence[-BEAMS][:FRAMES[:SEED]]`, BEAMS 16, 32, 64 (if not said) or 128, FRAMES 1 to
/// 1000000. Throws std::invalid_argument like parse_synth.
VergesSequenceSpec parse_verges_sequence(std::string_view text);

/// A run of street sweeps, frame 0 to frames - 1 (street.h).
struct StreetSequenceSpec {
  std::size_t frames = 22;
  std::uint64_t seed = 1;
};

/// Reads `street-sequence[:FRAMES[:SEED]]`, FRAMES 1 to 1000000. Throws std::invalid_argument like
/// parse_synth.
StreetSequenceSpec parse_street_sequence(std::string_view text);

}  // namespace pcl_bv
