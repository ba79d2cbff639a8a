// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Texts of the command line to values.

#include "values.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace pcl_bv {
namespace {

template <typename T>
bool read_all(std::string_view text, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

void add_once(std::vector<const Method*>& list, const Method* method) {
  if (std::find(list.begin(), list.end(), method) == list.end()) list.push_back(method);
}

void add_methods(std::vector<const Method*>& list, std::string_view name) {
  if (name == "all") {
    for (const Method* method : methods_of_all())
      add_once(list, method);
  } else if (const Method* method = find_method(name)) {
    add_once(list, method);
  } else {
    std::string known;
    for (const Method& each : methods())
      known += std::string(each.name) + ", ";
    throw UsageError("--volume: unknown method " + quoted(name) + "; known are " + known + "all");
  }
}

}  // namespace

std::string quoted(std::string_view text) {
  return "'" + std::string(text) + "'";
}

bool read_number(std::string_view text, double& value) {
  return read_all(text, value);
}

bool read_number(std::string_view text, float& value) {
  return read_all(text, value);
}

std::size_t parse_whole_number(std::string_view option, std::string_view text, std::size_t min,
                               std::size_t max) {
  std::size_t value = 0;
  if (read_all(text, value) && value >= min && value <= max) return value;
  std::string range = " is not a whole number of at least " + std::to_string(min);
  if (max != std::numeric_limits<std::size_t>::max()) range += " and at most " + std::to_string(max);
  throw UsageError(std::string(option) + ": " + quoted(text) + range);
}

std::pair<double, double> parse_range(std::string_view text) {
  double min = 0, max = 0;
  const std::size_t colon = text.find(':');
  if (colon != std::string_view::npos && read_all(text.substr(0, colon), min) &&
      read_all(text.substr(colon + 1), max) && min >= 0 && min <= max) {
    return {min, max};
  }
  throw UsageError("--range: " + quoted(text) + " is not MIN:MAX with 0 <= MIN <= MAX");
}

double parse_sensor_height(std::string_view text) {
  double value = 0;
  if (read_all(text, value) && std::isfinite(value) && value >= 0) return value;
  throw UsageError("--sensor-height: " + quoted(text) + " is not a finite height of at least 0");
}

std::size_t parse_bin_fields(std::string_view text) {
  return parse_whole_number("--bin-fields", text, 3, 32);
}

std::vector<const Method*> parse_methods(std::string_view list) {
  std::vector<const Method*> chosen;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t comma = std::min(list.find(',', begin), list.size());
    add_methods(chosen, list.substr(begin, comma - begin));
    begin = comma + 1;
  }
  return chosen;
}

}  // namespace pcl_bv
