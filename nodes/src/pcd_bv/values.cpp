// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Texts of the command line to values.

#include "values.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace pcl_bv {
namespace {

/// Methods of the documentation: a name of these that methods() does not hold is not built yet.
constexpr std::string_view documented_methods[] = {
    "aabb",          "dop6",         "dop14",         "dop18",         "dop26",         "sphere",
    "sphere-ritter", "sphere-epos6", "sphere-epos14", "sphere-epos26", "sphere-epos98", "sphere-exact",
    "obb",           "obb-pca",      "obb-dito14",    "obb-min",       "obb-yaw",       "obb-lshape",
    "cylinder",      "capsule",      "ellipsoid",     "hull",          "best"};

std::string quoted(std::string_view text) {
  return "'" + std::string(text) + "'";
}

template <typename T>
bool read_all(std::string_view text, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

void add_once(std::vector<const Method*>& list, const Method* method) {
  if (std::find(list.begin(), list.end(), method) == list.end()) list.push_back(method);
}

std::string known_methods() {
  std::string names;
  for (const Method& method : methods())
    names += std::string(method.name) + ", ";
  return names + "all";
}

void add_method(std::vector<const Method*>& list, std::string_view name) {
  if (name == "all") {
    for (const Method& method : methods()) {
      if (method.shape != "hull" && method.name != "best") add_once(list, &method);
    }
  } else if (const Method* method = find_method(name)) {
    add_once(list, method);
  } else if (std::find(std::begin(documented_methods), std::end(documented_methods), name) !=
             std::end(documented_methods)) {
    throw not_available_yet("--volume " + std::string(name));
  } else {
    throw UsageError("--volume: unknown method " + quoted(name) + "; known are " + known_methods());
  }
}

}  // namespace

UsageError not_available_yet(const std::string& what) {
  return UsageError(what + ": not available yet");
}

std::size_t parse_whole_number(std::string_view option, std::string_view text, std::size_t min,
                               std::size_t max) {
  std::size_t value = 0;
  if (read_all(text, value) && value >= min && value <= max) return value;
  std::string range = " is not a whole number of at least " + std::to_string(min);
  if (max != std::numeric_limits<std::size_t>::max()) range += " and at most " + std::to_string(max);
  throw UsageError(std::string(option) + ": " + quoted(text) + range);
}

float parse_tolerance(std::string_view text) {
  float value = 0;
  if (read_all(text, value) && std::isfinite(value) && value > 0) return value;
  throw UsageError("--cluster: " + quoted(text) + " is not a finite distance above 0");
}

RangeFilter parse_range(std::string_view text) {
  RangeFilter range;
  const std::size_t colon = text.find(':');
  if (colon != std::string_view::npos && read_all(text.substr(0, colon), range.min) &&
      read_all(text.substr(colon + 1), range.max) && range.min >= 0 && range.min <= range.max) {
    return range;
  }
  throw UsageError("--range: " + quoted(text) + " is not MIN:MAX with 0 <= MIN <= MAX");
}

std::optional<GroundOptions> parse_ground(std::string_view kind) {
  if (kind == "none") return std::nullopt;
  if (kind == "plane") return GroundOptions{};
  if (kind == "zones") return GroundOptions{GroundKind::zones, UpAxis::z, {}};
  throw UsageError("--ground: unknown kind " + quoted(kind) + "; known are none, plane, zones");
}

UpAxis parse_up(std::string_view text) {
  try {
    return parse_up_axis(text);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--up: ") + error.what());
  }
}

double parse_sensor_height(std::string_view text) {
  double value = 0;
  if (read_all(text, value) && std::isfinite(value) && value >= 0) return value;
  throw UsageError("--sensor-height: " + quoted(text) + " is not a finite height of at least 0");
}

OutputFormat parse_format(std::string_view text) {
  if (text == "text") return OutputFormat::text;
  if (text == "json") return OutputFormat::json;
  if (text == "jsonl") return OutputFormat::jsonl;
  if (text == "csv") return OutputFormat::csv;
  throw UsageError("--format: unknown format " + quoted(text) + "; known are text, json, jsonl, csv");
}

ViewFrom parse_view(std::string_view text) {
  if (text == "iso") return ViewFrom::iso;
  if (text == "top") return ViewFrom::top;
  if (text == "front") return ViewFrom::front;
  if (text == "side") return ViewFrom::side;
  throw UsageError("--view: unknown view " + quoted(text) + "; known are iso, top, front, side");
}

Isa parse_usable_isa(const std::string& text) {
  try {
    return resolve_isa(parse_isa(text));
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

SphereGrowth parse_sphere_growth(std::string_view text) {
  try {
    return parse_growth(text);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--growth: ") + error.what());
  }
}

std::vector<const Method*> parse_methods(std::string_view list) {
  std::vector<const Method*> chosen;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t comma = std::min(list.find(',', begin), list.size());
    add_method(chosen, list.substr(begin, comma - begin));
    begin = comma + 1;
  }
  return chosen;
}

std::vector<const Method*> default_methods() {
  std::vector<const Method*> chosen;
  for (const std::string_view name : {"aabb", "sphere", "obb"}) {
    if (const Method* method = find_method(name)) chosen.push_back(method);
  }
  return chosen;
}

}  // namespace pcl_bv
