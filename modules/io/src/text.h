// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Parses and formats words and numbers, independent of the locale. Unlike std::from_chars, accepts "+1" and
// gives values outside the range of a floating-point type (infinity or zero).
#pragma once

#include <charconv>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "pcl_bv/io/posix_file.h"

namespace pcl_bv {

/// Maximum size of a header in bytes. Most headers have 200 to 400 bytes, but some exporters store the scan's
/// metadata in comments of 100 kB.
inline constexpr std::size_t kMaxHeaderBytes = 1 << 20;

/// Calls parse(start, more) with the beginning of the file: 64 KiB, then more each time, until it returns
/// true. `parse` returns false if the header does not end in `start`. `more`: the file is longer than
/// `start`. Throws IoError, naming `last_line`, if the header does not end in the file or in kMaxHeaderBytes
/// bytes.
void parse_header(const InputFile& file, const char* last_line,
                  const std::function<bool(std::string_view start, bool more)>& parse);

using Words = std::vector<std::string_view>;

/// Returns the words of a line, which are separated by blanks.
Words split(std::string_view line);

/// Whether the text can be a field's name: not empty, without blanks and line ends.
bool is_word(std::string_view text);

/// Returns the value of a well-formed decimal number that std::from_chars reported as out of range: an
/// infinity or a zero with the number's sign.
double value_beyond_range(std::string_view number);

/// Reads the number at the beginning of [at, end). Floating point is rounded to nearest; "nan" and "inf" are
/// numbers; integers must be in range. Returns the position behind the number, or null if there is none of
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
