// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <optional>
#include <set>

#include "name_times.h"
#include "pcl_bv/io/number_text.h"
#include "pcl_bv/nodes/frame_source.h"

namespace pcl_bv::detail {
namespace {

constexpr std::string_view kDigits = "0123456789";

std::vector<std::string_view> digits_in(std::string_view stem) {
  std::vector<std::string_view> all;
  for (std::size_t at = stem.find_first_of(kDigits); at != std::string_view::npos;) {
    const std::size_t end = std::min(stem.find_first_not_of(kDigits, at), stem.size());
    all.push_back(stem.substr(at, end - at));
    at = stem.find_first_of(kDigits, end);
  }
  return all;
}

// Returns the position, in the lists of digits, of the number that differs between the names.
std::optional<std::size_t> varying_position(const std::vector<std::vector<std::string_view>>& names) {
  const std::size_t count = names.front().size();
  const auto same_count = [&](const auto& digits) { return digits.size() == count; };
  if (count == 0 || !std::all_of(names.begin(), names.end(), same_count)) return std::nullopt;
  if (count == 1) return 0;
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < count; ++i) {
    const auto is_first = [&](const auto& digits) { return digits[i] == names.front()[i]; };
    if (std::all_of(names.begin(), names.end(), is_first)) continue;
    if (found) return std::nullopt;
    found = i;
  }
  return found;
}

}  // namespace

std::vector<std::size_t> numbers_of_names(const std::vector<std::string>& stems) {
  std::vector<std::vector<std::string_view>> all;
  for (const std::string& stem : stems) {
    if (stamp_in_name(stem) >= 0) return {};
    all.push_back(digits_in(stem));
  }
  const std::optional<std::size_t> position = all.empty() ? std::nullopt : varying_position(all);
  if (!position) return {};
  std::vector<std::size_t> numbers;
  std::set<std::size_t> known;
  for (const std::vector<std::string_view>& digits : all) {
    std::string_view text = digits[*position];
    std::size_t number = 0;
    if (!next_number(text, number) || !known.insert(number).second) return {};
    numbers.push_back(number);
  }
  return numbers;
}

}  // namespace pcl_bv::detail
