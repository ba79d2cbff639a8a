// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "hesai_correction.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>

#include "pcl_bv/io/untrusted_text.h"
#include "pcl_bv/recording/recording.h"

namespace pcl_bv::detail {
namespace {

constexpr std::size_t kMaxHesaiChannels = 128;

std::string_view without_spaces(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

template <class Number>
std::optional<Number> number_of_text(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

// Removes the text up to the separator from `rest` and returns it.
std::string_view take_until(char separator, std::string_view& rest) {
  const std::size_t end = std::min(rest.find(separator), rest.size());
  const std::string_view taken = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return without_spaces(taken);
}

struct HesaiRow {
  std::size_t channel;
  HesaiAngles angles;
};

// Returns the row in a line, or nullopt for lines with other content.
std::optional<HesaiRow> row_of(std::string_view line) {
  const auto channel = number_of_text<std::size_t>(take_until(',', line));
  const auto elevation = number_of_text<double>(take_until(',', line));
  const auto azimuth = number_of_text<double>(without_spaces(line));
  if (!channel || !elevation || !azimuth) return std::nullopt;
  return HesaiRow{*channel, {*elevation, *azimuth}};
}

}  // namespace

std::vector<HesaiAngles> parse_hesai_correction(std::string_view csv) {
  std::vector<HesaiAngles> all;
  while (!csv.empty()) {
    const std::optional<HesaiRow> row = row_of(take_until('\n', csv));
    if (!row) continue;
    const std::string name = "channel " + std::to_string(row->channel);
    if (row->channel != all.size() + 1)
      throw IoError("has " + name + " where channel " + std::to_string(all.size() + 1) + " must be");
    if (all.size() == kMaxHesaiChannels)
      throw IoError("has more than " + std::to_string(kMaxHesaiChannels) + " channels");
    if (!(std::abs(row->angles.elevation) <= 90) || !(std::abs(row->angles.azimuth) <= 360))
      throw IoError("has an elevation beyond 90 or an azimuth beyond 360 degrees for " + name);
    all.push_back(row->angles);
  }
  if (all.empty()) throw IoError("has no rows \"channel,elevation,azimuth\"");
  return all;
}

std::filesystem::path own_hesai_correction(const std::filesystem::path& capture, bool has_mirrors) {
  std::filesystem::path own = capture;
  return own.replace_extension(has_mirrors ? ".dat" : ".csv");
}

}  // namespace pcl_bv::detail
