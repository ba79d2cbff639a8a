// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Functions for headers, words and numbers of text files.
#pragma once

#include <charconv>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "pcl_bv/io/number_text.h"
#include "pcl_bv/io/posix_file.h"

namespace pcl_bv::detail {

/// Maximum size of a header in bytes. Most headers have 200 to 400 bytes, but some exporters store metadata
/// of 100 kB in comments.
inline constexpr std::size_t kMaxHeaderBytes = 1 << 20;

/// Calls parse(start, more) with the beginning `start` of the file until parse() returns true. The first
/// `start` has 64 KiB, each later `start` is longer. `more` is whether the file is longer than `start`.
/// parse() returns false if the header does not end in `start`. Throws IoError, naming `last_line`, if the
/// header does not end in the file or in its first kMaxHeaderBytes bytes.
void parse_header(const InputFile& file, const char* last_line,
                  const std::function<bool(std::string_view start, bool more)>& parse);

using Words = std::vector<std::string_view>;

/// Returns the words of a line, which are separated by blanks.
Words split(std::string_view line);

/// Returns whether the text can be a field's name, which is not empty and has no blanks or line ends.
bool is_word(std::string_view text);

/// Returns whether the whole word is a number of this type.
template <typename T>
bool read_number(std::string_view word, T& value) {
  const char* end = word.data() + word.size();
  return parse_number(word.data(), end, value) == end;
}

/// Appends the number with the fewest digits that read back as the same number.
template <typename T>
void append_number(std::string& text, T value) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

}  // namespace pcl_bv::detail
