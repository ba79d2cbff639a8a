// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The table of scenes and the parsers of their names.
#include "pcl_bv/synth/synth.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <stdexcept>
#include <vector>

#include "pcl_bv/synth/rig_drive.h"
#include "pcl_bv/synth/rural_road.h"
#include "pcl_bv/synth/shapes.h"
#include "pcl_bv/synth/street.h"
#include "pcl_bv/synth/town.h"

namespace pcl_bv {
using namespace detail;
namespace {

constexpr std::uint64_t max_points = 2'000'000'000;
constexpr std::uint64_t max_frames = 1'000'000;

struct Scene {
  std::string_view name;
  std::size_t points;
  bool fixed_size;
  SynthCloud (*make)(std::size_t points, std::uint64_t seed);
};

SynthCloud make_paper(std::size_t points, std::uint64_t seed) {
  return make_surface(points, seed, static_cast<double>(points));
}

template <std::size_t beams>
SynthCloud make_rural_road(std::size_t, std::uint64_t seed) {
  return make_rural_road_frame({seed, beams}, 0).cloud;
}

constexpr std::array scenes{
    Scene{"street", StreetOptions{}.points, false,
          [](std::size_t points, std::uint64_t seed) {
            return make_street_frame({points, seed}, 0).cloud;
          }},
    Scene{"sphere", 100'000, false, make_sphere},
    Scene{"box", 100'000, false, make_box},
    Scene{"gauss", 100'000, false, make_gauss},
    Scene{"surface", 100'000, false,
          [](std::size_t points, std::uint64_t seed) { return make_surface(points, seed); }},
    Scene{"paper-4010", 4'010, true, make_paper},
    Scene{"paper-7260", 7'260, true, make_paper},
    Scene{"paper-30892", 30'892, true, make_paper},
    Scene{"paper-32875", 32'875, true, make_paper},
    Scene{"paper-48485", 48'485, true, make_paper},
    Scene{"paper-100722", 100'722, true, make_paper},
    Scene{"paper-327323", 327'323, true, make_paper},
    Scene{"rural-road", 128'000, true, make_rural_road<64>},
    Scene{"rural-road-16", 28'800, true, make_rural_road<16>},
    Scene{"rural-road-32", 57'600, true, make_rural_road<32>},
    Scene{"rural-road-128", 230'400, true, make_rural_road<128>},
};

/// Replaces `verges`, the old name of `rural-road`, in a scene's name. Returns other names unchanged.
std::string current_name(std::string_view name) {
  constexpr std::string_view old_name = "verges";
  if (name != old_name && !name.starts_with("verges-")) return std::string(name);
  return "rural-road" + std::string(name.substr(old_name.size()));
}

const Scene& find_scene(std::string_view name) {
  const std::string current = current_name(name);
  const auto scene =
      std::find_if(scenes.begin(), scenes.end(), [&current](const Scene& s) { return s.name == current; });
  if (scene == scenes.end()) {
    throw std::invalid_argument("unknown scene '" + std::string(name) + "', expected one of " +
                                synth_names());
  }
  return *scene;
}

std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> parts;
  for (std::size_t colon = text.find(':'); colon != text.npos; colon = text.find(':')) {
    parts.push_back(text.substr(0, colon));
    text.remove_prefix(colon + 1);
  }
  parts.push_back(text);
  return parts;
}

std::uint64_t whole_number(std::string_view what, std::string_view text, std::uint64_t low,
                           std::uint64_t high) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value < low || value > high) {
    throw std::invalid_argument(std::string(what) + " '" + std::string(text) +
                                "' is not a whole number from " + std::to_string(low) + " to " +
                                std::to_string(high));
  }
  return value;
}

/// Splits NAME[:COUNT[:SEED]] at the colons. `count_name` is the name of COUNT in the error message.
std::vector<std::string_view> split_spec(std::string_view text, std::string_view count_name) {
  std::vector<std::string_view> parts = split(text);
  if (parts.size() > 3) {
    throw std::invalid_argument("'" + std::string(text) + "' has too many parts, expected " +
                                std::string(parts[0]) + "[:" + std::string(count_name) + "[:SEED]]");
  }
  return parts;
}

std::uint64_t seed_of(const std::vector<std::string_view>& parts) {
  return parts.size() > 2 ? whole_number("SEED", parts[2], 0, UINT64_MAX) : 1;
}

constexpr std::string_view rural_road_sequence = "rural-road-sequence";

}  // namespace

SynthOptions parse_synth(std::string_view text) {
  const auto parts = split_spec(text, "POINTS");
  const Scene& scene = find_scene(parts[0]);
  SynthOptions spec{std::string(scene.name), scene.points, seed_of(parts)};
  if (parts.size() > 1) spec.points = whole_number("POINTS", parts[1], 1, max_points);
  if (scene.fixed_size && spec.points != scene.points) {
    throw std::invalid_argument("POINTS '" + std::string(parts[1]) + "' is not allowed: " + spec.name +
                                " has " + std::to_string(scene.points) + " points");
  }
  if (spec.name == "street") spec.points = street_rays(spec.points);
  return spec;
}

SynthCloud make_synth(const SynthOptions& spec) {
  return find_scene(spec.name).make(spec.points, spec.seed);
}

std::string synth_names() {
  std::string names;
  for (const Scene& scene : scenes)
    names.append(names.empty() ? "" : ", ").append(scene.name);
  return names;
}

bool is_rural_road_sequence(std::string_view text) {
  return current_name(text.substr(0, text.find(':'))).starts_with(rural_road_sequence);
}

RuralRoadSequenceOptions parse_rural_road_sequence(std::string_view text) {
  const auto parts = split_spec(text, "FRAMES");
  RuralRoadSequenceOptions spec;
  const std::string name = current_name(parts[0]);
  if (name != rural_road_sequence) {
    constexpr std::array<std::string_view, 4> sensors{"16", "32", "64", "128"};
    const std::string sensor =
        name.starts_with(rural_road_sequence) ? name.substr(rural_road_sequence.size()) : std::string();
    const auto known = std::find_if(sensors.begin(), sensors.end(), [&sensor](std::string_view beams) {
      return sensor.starts_with('-') && sensor.substr(1) == beams;
    });
    if (known == sensors.end()) {
      throw std::invalid_argument("unknown sequence '" + std::string(parts[0]) +
                                  "', expected rural-road-sequence[-16|-32|-64|-128] (number of beams)");
    }
    spec.options.beams = whole_number("BEAMS", *known, 16, 128);
  }
  spec.options.seed = seed_of(parts);
  if (parts.size() > 1) spec.frames = whole_number("FRAMES", parts[1], 1, max_frames);
  return spec;
}

StreetSequenceOptions parse_street_sequence(std::string_view text) {
  const auto parts = split_spec(text, "FRAMES");
  if (parts[0] != "street-sequence") {
    throw std::invalid_argument("unknown sequence '" + std::string(parts[0]) +
                                "', expected street-sequence or rural-road-sequence[-BEAMS]");
  }
  StreetSequenceOptions spec;
  spec.seed = seed_of(parts);
  if (parts.size() > 1) spec.frames = whole_number("FRAMES", parts[1], 1, max_frames);
  return spec;
}

bool detail::is_rig_sequence(const std::string& text) {
  return text.substr(0, text.find(':')) == "rig";
}

detail::RigSequence detail::parse_rig_sequence(const std::string& text) {
  const auto parts = split_spec(text, "FRAMES");
  if (parts[0] != "rig")
    throw std::invalid_argument("unknown sequence '" + std::string(parts[0]) + "', expected rig");
  RigSequence spec;
  spec.seed = seed_of(parts);
  if (parts.size() > 1) spec.frames = whole_number("FRAMES", parts[1], 1, max_frames);
  return spec;
}

bool detail::is_town(const std::string& text) {
  const std::string name = text.substr(0, text.find(':'));
  return name == "town" || name == "town-objects";
}

detail::TownSequence detail::parse_town(const std::string& text) {
  const auto parts = split(text);
  if (!is_town(text))
    throw std::invalid_argument("unknown scene '" + std::string(parts[0]) +
                                "', expected town or town-objects");
  if (parts.size() > 4)
    throw std::invalid_argument("'" + text + "' has too many parts, expected " + std::string(parts[0]) +
                                "[:TILES[:SEED[:POINTS]]]");
  TownSequence spec;
  spec.options.ground = parts[0] == "town";
  spec.options.seed = seed_of(parts);
  if (parts.size() > 1) spec.tiles = whole_number("TILES", parts[1], 1, 100'000);
  if (parts.size() > 3) spec.options.points_per_tile = whole_number("POINTS", parts[3], 1000, 100'000'000);
  return spec;
}

}  // namespace pcl_bv
