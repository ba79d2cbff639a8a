// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Texts to values that only this command has.

#include "values.h"

#include <cmath>

#include "command/values.h"

namespace pcl_bv {

float parse_tolerance(std::string_view text) {
  float value = 0;
  if (read_number(text, value) && std::isfinite(value) && value > 0) return value;
  throw UsageError("--cluster: " + quoted(text) + " is not a finite distance above 0");
}

std::optional<GroundOptions> parse_ground(std::string_view kind) {
  if (kind == "none") return std::nullopt;
  if (kind == "plane") return GroundOptions{};
  if (kind == "zones") return GroundOptions{.kind = GroundKind::zones, .sensor_height = {}};
  throw UsageError("--ground: unknown kind " + quoted(kind) + "; known are none, plane, zones");
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

UsableIsa parse_usable_isa(const std::string& text) {
  try {
    return parse_isa(text);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

std::vector<const Method*> default_methods() {
  return {find_method("aabb"), find_method("sphere"), find_method("obb")};
}

}  // namespace pcl_bv
