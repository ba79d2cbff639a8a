// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "separated_text.h"

#include <algorithm>
#include <cstdint>

#include "short_decimal.h"

namespace pcl_bv::detail {
namespace {

std::string_view trimmed(std::string_view text, std::string_view around = " \t\r\v\f\"'") {
  const std::size_t begin = text.find_first_not_of(around);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(around) - begin + 1);
}

// Returns the end of the quoted value that begins at `quote`, behind its last quote, or npos if it is not
// closed. Two double quotes inside of it stand for one.
std::size_t end_of_quotes(std::string_view line, std::size_t quote) {
  for (std::size_t at = quote + 1; (at = line.find('"', at)) != std::string_view::npos; at += 2) {
    if (at + 1 == line.size() || line[at + 1] != '"') return at + 1;
  }
  return std::string_view::npos;
}

// Returns the position of the separator behind the value that begins at `at`, or the end of the line.
std::size_t end_of_value(std::string_view line, std::size_t at, char separator) {
  const auto skip_blanks = [&](std::size_t from) {
    while (from < line.size() && is_blank(line[from]))
      ++from;
    return from;
  };
  const std::size_t begin = skip_blanks(at);
  if (begin < line.size() && line[begin] == '"') {
    const std::size_t quoted = end_of_quotes(line, begin);
    const std::size_t end = quoted == std::string_view::npos ? quoted : skip_blanks(quoted);
    if (end == line.size() || (end < line.size() && line[end] == separator)) return end;
  }
  return std::min(line.find(separator, at), line.size());
}

// Returns the end of the last value that is not empty, or 0.
std::size_t end_of_values(std::string_view line, char separator) {
  std::size_t end = line.size();
  while (end > 0 && (is_blank(line[end - 1]) || line[end - 1] == separator))
    --end;
  return end;
}

char* write_line(std::string_view line, char separator, std::size_t columns, char* to) {
  const std::size_t last = end_of_values(line, separator);
  std::size_t number = 0;
  for (std::size_t at = 0; at < last || (number < columns && at <= line.size()); ++number) {
    const std::size_t end = end_of_value(line, at, separator);
    const std::string_view value = trimmed(line.substr(at, end - at));
    to = std::transform(value.begin(), value.end(), to, [](char c) { return is_blank(c) ? kInnerBlank : c; });
    if (value.empty()) *to++ = kInnerBlank;
    *to++ = ' ';
    at = end + 1;
  }
  return to;
}

}  // namespace

std::string_view without_blanks_around(std::string_view text) {
  return trimmed(text, " \t\r\v\f");
}

char separator_of(std::string_view line) {
  for (const char separator : {';', ','})
    if (line.find(separator) != std::string_view::npos) return separator;
  return ' ';
}

Words split_all_columns(std::string_view line, char separator) {
  if (separator == ' ') return split(trimmed(line));
  Words words;
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = end_of_value(line, at, separator);
    words.push_back(trimmed(line.substr(at, end - at)));
    at = end + 1;
  }
  return words;
}

Words split_columns(std::string_view line, char separator) {
  Words words = split_all_columns(line, separator);
  while (!words.empty() && words.back().empty())
    words.pop_back();
  return words;
}

bool has_plain_values(std::string_view text, char separator) {
  // A blank next to a separator or to the end of a line is outside of values. Blanks between two of them
  // stand for an empty value. The loop has no branches, so that the compiler vectorises it.
  if (text.empty() || text[0] == separator || text.back() == separator) return text.empty();
  std::uint8_t special = is_blank(text[0]);
  for (std::size_t i = 1; i < text.size(); ++i) {
    const char before = text[i - 1], c = text[i], next = i + 1 < text.size() ? text[i + 1] : '\n';
    const std::uint8_t begins = (before == separator) | (before == '\n');
    const std::uint8_t ends = (c == separator) | (c == '\n') | (c == '\r');
    const std::uint8_t next_ends = (next == separator) | (next == '\n') | (next == '\r');
    const std::uint8_t is_space = (c == ' ') | (c == '\t') | (c == '\v') | (c == '\f');
    special |= (c == '"') | (c == '\'');
    special |= is_space & ((begins ^ next_ends) ^ 1);
    special |= begins & ends & ((before == separator) | (c == separator));
  }
  return special == 0;
}

char* separate_by_blanks(std::string_view text, char separator, std::size_t columns, char* to) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = without_blanks_around(text.substr(at, end - at));
    if (end_of_values(line, separator) > 0) to = write_line(line, separator, columns, to);
    if (end < text.size()) *to++ = '\n';
    at = end + 1;
  }
  return to;
}

}  // namespace pcl_bv::detail
