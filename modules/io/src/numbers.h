// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Numbers from and to text, whatever the locale, with the two things that std::from_chars leaves open: "+1"
// and numbers beyond the range of the type.
#pragma once

#include <charconv>
#include <string>
#include <string_view>
#include <type_traits>

namespace pcl_bv {

/// The value of a well-formed decimal number that std::from_chars found out of range: an infinity or a zero,
/// signed.
double value_beyond_range(std::string_view number);

/// Reads the number at the front of [at, end). Floating point is rounded to nearest; "nan" and "inf" are
/// numbers; integers must be in range. Returns where it ends, or null if there is no number of this type.
template <typename T>
const char* parse_number(const char* at, const char* end, T& value) {
  if (end - at > 1 && at[0] == '+' && at[1] != '-') ++at;
  const auto [after, error] = std::from_chars(at, end, value);
  if (error == std::errc()) return after;
  if constexpr (std::is_floating_point_v<T>) {
    if (error == std::errc::result_out_of_range) {
      value = static_cast<T>(value_beyond_range({at, static_cast<std::size_t>(after - at)}));
      return after;
    }
  }
  return nullptr;
}

/// Whether the whole word is a number of this type.
template <typename T>
bool read_number(std::string_view word, T& value) {
  const char* end = word.data() + word.size();
  return parse_number(word.data(), end, value) == end;
}

/// Appends the fewest digits that read back as the same number.
template <typename T>
void append_number(std::string& text, T value) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

}  // namespace pcl_bv
