// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Texts to values that only this command has.

#include "values.h"

#include "command/values.h"
#include "pcl_bv/nodes/settings.h"

namespace pcl_bv {

OriginOption parse_origin(std::string_view text) {
  OriginOption origin{true, {}};
  if (text == "auto") return origin;
  parse_with("--origin", text, [&](std::string_view numbers) { read_text(numbers, origin.at); });
  if (origin.at && origin.at->allFinite()) return origin;
  throw UsageError("--origin: " + quoted(text) + " is not X,Y,Z, all finite, or auto");
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

}  // namespace pcl_bv
