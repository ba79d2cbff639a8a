// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Parses a text as one of several names or as one number.
#pragma once

#include <array>
#include <charconv>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace pcl_bv::detail {

template <typename Choice, std::size_t n>
using Names = std::array<std::pair<std::string_view, Choice>, n>;

/// Returns the value of the name that equals the text. If there is none, throws std::invalid_argument with a
/// list of the names.
template <typename Choice, std::size_t n>
Choice read_name(const Names<Choice, n>& names, std::string_view text) {
  std::string known;
  for (const auto& [name, choice] : names) {
    if (name == text) return choice;
    known += (known.empty() ? "" : ", ") + std::string(name);
  }
  throw std::invalid_argument("'" + std::string(text) + "' is not one of " + known);
}

/// Parses the whole text as a number. Returns false if it is not a number or out of range.
template <typename Number>
bool read_whole_text(std::string_view text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace pcl_bv::detail
