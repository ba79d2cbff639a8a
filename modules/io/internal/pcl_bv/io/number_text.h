// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reads and writes numbers with a decimal point in every locale. A program may set a locale with a decimal
// comma, as programs with Qt do in Germany. In it, printf writes "1,5", and a stream reads "1.250" as 1250.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Returns the value of a well-formed decimal number that std::from_chars reported as out of range. The value
/// is infinity or zero with the number's sign.
double value_beyond_range(std::string_view number);

/// Reads the number at the beginning of [at, end). Accepts "+1", unlike std::from_chars. Floating point is
/// rounded to nearest, "nan" and "inf" are accepted, and values outside the type's range become infinity or
/// zero. Integers must be in range. Returns the position after the number, or null if there is no number of
/// this type.
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

/// Removes leading separators, then a number, from `text`. If no number follows, removes only the separators
/// and returns false.
template <typename T>
bool next_number(std::string_view& text, T& value, std::string_view separators = " \t\r\n\v\f") {
  text.remove_prefix(std::min(text.find_first_not_of(separators), text.size()));
  const char* const after = parse_number(text.data(), text.data() + text.size(), value);
  if (after == nullptr) return false;
  text.remove_prefix(static_cast<std::size_t>(after - text.data()));
  return true;
}

/// Returns the text that printf writes with `%.*f` in the C locale. `decimals` must be at most 40. Negative
/// zero is written as 0, but fixed_text(-0.04, 1) is "-0.0".
inline std::string fixed_text(double value, int decimals) {
  char text[360];  // the largest double has 309 digits before the point
  const std::chars_format format = std::chars_format::fixed;
  return {text, std::to_chars(text, text + sizeof text, value == 0 ? 0.0 : value, format, decimals).ptr};
}

/// Returns the text that printf writes with `%.*g` in the C locale. `digits` must be at most 40. Negative
/// zero is written as 0.
inline std::string general_text(double value, int digits) {
  char text[60];
  const std::chars_format format = std::chars_format::general;
  return {text, std::to_chars(text, text + sizeof text, value == 0 ? 0.0 : value, format, digits).ptr};
}

}  // namespace detail
}  // namespace pcl_bv
