// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A text file gets a header that describes it as an ascii .pcd file.

#include "pcl_bv/io/text_cloud.h"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "fields.h"
#include "pcd_format.h"
#include "text.h"
#include "text_rows.h"

namespace pcl_bv::detail {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view around = " \t\r\"'";
  const std::size_t begin = text.find_first_not_of(around);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(around) - begin + 1);
}

// Returns the values of a line. A separator at its end adds none.
Words split_columns(std::string_view line, char separator) {
  if (separator == ' ') return split(line);
  Words words;
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t end = std::min(line.find(separator, at), line.size());
    words.push_back(trimmed(line.substr(at, end - at)));
    at = end + 1;
  }
  if (!words.empty() && words.back().empty()) words.pop_back();
  return words;
}

char separator_of(std::string_view line) {
  for (const char separator : {';', ','})
    if (line.find(separator) != std::string_view::npos) return separator;
  return ' ';
}

// Columns whose values must be numbers in the first row: those of the coordinates if names are known, because
// other columns may have text. Otherwise all.
using ColumnNumbers = std::vector<std::size_t>;

template <typename Named>
ColumnNumbers coordinate_columns(const Named& names) {
  ColumnNumbers found;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (is_coordinate_name(names[i])) found.push_back(i);
  return found;
}

bool is_row_of_numbers(std::string_view line, const ColumnNumbers& wanted) {
  const Words words = split_columns(line, separator_of(line));
  const auto is_number = [&](std::string_view word) {
    double value = 0;
    return read_number(word, value);
  };
  if (wanted.size() < 3) return !words.empty() && std::all_of(words.begin(), words.end(), is_number);
  return std::all_of(wanted.begin(), wanted.end(),
                     [&](std::size_t i) { return i < words.size() && is_number(words[i]); });
}

PointField parse_column(std::string_view text) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  PointField field{std::string(text.substr(0, colon)), 'F', 8, 1, 0};
  const auto refuse_column = [&](const char* what) { throw std::invalid_argument(in_quotes(text) + what); };
  if (!is_word(field.name)) refuse_column(" is no name of a column");
  if (colon == text.size()) return field;
  const std::string_view type = text.substr(colon + 1);
  const std::size_t letter = type.size() == 2 ? std::string_view("fiu").find(type[0]) : 3;
  const bool size = type.size() == 2 && std::string_view("1248").find(type[1]) != std::string_view::npos;
  if (letter > 2 || !size || (letter == 0 && type[1] < '4'))
    refuse_column(": the type is not f4, f8, or i or u with 1, 2, 4 or 8");
  field.type = "FIU"[letter];
  field.size = static_cast<std::uint32_t>(type[1] - '0');
  return field;
}

// The lines before the numbers.
struct TextStart {
  std::size_t begin = 0;    // of the first line of numbers
  std::size_t columns = 0;  // in this line
  char separator = ' ';     // in this line
  std::string_view header;  // the last line that is not blank before it, without # and //
  bool header_is_comment = false;
};

// Returns nothing if the numbers begin behind the text.
std::optional<TextStart> find_numbers(std::string_view text, bool more, ColumnNumbers wanted) {
  TextStart start;
  bool other_text = false;
  for (std::size_t at = text.starts_with("\xEF\xBB\xBF") ? 3 : 0; at < text.size();) {
    const std::size_t newline = text.find('\n', at);
    if (newline == std::string_view::npos && more) return std::nullopt;
    const std::size_t end = std::min(newline, text.size());
    std::string_view line = trimmed(text.substr(at, end - at));
    const std::size_t begin = std::exchange(at, end + 1);
    if (line.empty()) continue;
    const bool is_count = start.begin == 0 && at < text.size() && is_row_of_numbers(line, {}) &&
                          split_columns(line, ' ').size() == 1 && separator_of(line) == ' ';
    if (is_count) {  // of a .pts file
      start.begin = 1;
      continue;
    }
    if (is_row_of_numbers(line, wanted)) {
      start.separator = separator_of(line);
      start.columns = split_columns(line, start.separator).size();
      start.begin = begin;
      return start;
    }
    const std::size_t comment = line.find_first_not_of("#/");
    start.header_is_comment = comment != 0;
    if (!start.header_is_comment && std::exchange(other_text, true))
      throw IoError("line " + in_quotes(line) + " is neither numbers nor a header");
    start.header = comment == std::string_view::npos ? std::string_view() : trimmed(line.substr(comment));
    if (wanted.size() < 3 && !start.header_is_comment)
      wanted = coordinate_columns(split_columns(start.header, separator_of(start.header)));
  }
  if (!more) throw IoError("has no line of numbers");
  return std::nullopt;
}

void add_named_columns(const TextStart& start, RawCloud& cloud) {
  const char separator = start.separator == ' ' ? separator_of(start.header) : start.separator;
  const Words names = split_columns(start.header, separator);
  const bool fits = names.size() == start.columns;
  if (!fits && !start.header.empty() && !start.header_is_comment)
    throw IoError("the header has " + std::to_string(names.size()) +
                  " names, the first line of numbers has " + std::to_string(start.columns) + " values");
  for (std::size_t i = 0; i < start.columns; ++i) {
    std::string name = default_column_name(i, start.columns);
    if (fits) {
      name = names[i];
      std::replace_if(
          name.begin(), name.end(), [](char c) { return c == ' ' || c == '\t'; }, '_');
    }
    if (!is_word(name)) throw IoError("column " + std::to_string(i + 1) + " has no name in the header");
    append_field({std::move(name), 'F', 8, 1, 0}, cloud);
  }
}

}  // namespace

std::vector<PointField> parse_columns(std::string_view columns) {
  std::vector<PointField> fields;
  for (std::size_t at = 0; at <= columns.size();) {
    const std::size_t end = std::min(columns.find(',', at), columns.size());
    fields.push_back(parse_column(columns.substr(at, end - at)));
    at = end + 1;
    if (fields.size() > kMaxColumns) throw std::invalid_argument("more than 4096 columns");
    for (std::size_t i = 0; i + 1 < fields.size(); ++i)
      if (fields[i].name == fields.back().name && fields[i].name != "_")
        throw std::invalid_argument(in_quotes(fields[i].name) + " occurs twice");
  }
  check_coordinates<std::invalid_argument>(fields);
  return fields;
}

PcdHeader read_text_header(const InputFile& file, std::string_view columns) {
  PcdHeader header;
  RawCloud& cloud = header.cloud;
  std::vector<std::string> names;
  for (const PointField& field : columns.empty() ? std::vector<PointField>() : parse_columns(columns))
    names.push_back(field.name);
  parse_header(file, "line of numbers", [&](std::string_view text, bool more) {
    const std::optional<TextStart> start = find_numbers(text, more, coordinate_columns(names));
    if (!start) return false;
    if (start->columns > kMaxColumns) throw IoError("more than 4096 columns");
    header.data_offset = start->begin;
    header.separator = start->separator;
    if (columns.empty()) {
      add_named_columns(*start, cloud);
    } else {
      for (PointField& field : parse_columns(columns))
        append_field(std::move(field), cloud);
      if (cloud.fields.size() != start->columns)
        throw IoError("the first line of numbers has " + std::to_string(start->columns) +
                      " values, not the " + std::to_string(cloud.fields.size()) + " of --columns");
    }
    return true;
  });
  TextBody body{file, header.data_offset, false, header.separator};
  cloud.width = skip_text_rows(body, static_cast<std::size_t>(-1));
  require_coordinates(cloud);
  return header;
}

}  // namespace pcl_bv::detail
