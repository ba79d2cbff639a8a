// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Words and numbers of text, whatever the locale. With numbers, two things that std::from_chars leaves open:
// "+1", and what is beyond the range of the type.
#pragma once

#include <charconv>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "pcl_bv/io/posix_file.h"

namespace pcl_bv {

/// A header must end within this many bytes. Those of most files have 200 to 400, but some exporters keep a
/// scan's metadata in comments of 100 kB.
inline constexpr std::size_t max_header_size = 1 << 20;

/// Calls parse(start, more) with the beginning of the file, 64 KiB at first, as long as it returns false (the
/// header does not end there) and there are more bytes to give it. `more`: whether it is not the whole file.
/// Throws IoError for a header without its `last_line`.
void parse_header(const InputFile& file, const char* last_line,
                  const std::function<bool(std::string_view start, bool more)>& parse);

using Words = std::vector<std::string_view>;

/// The words of a line, between blanks.
Words split(std::string_view line);

/// Whether the text has no blanks or line ends and is not empty, so that it can be the name of a field.
bool is_word(std::string_view text);

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
