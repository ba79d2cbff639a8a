// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A text file gets a header that describes it as an ascii .pcd file.

#include "pcl_bv/io/text_cloud.h"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "fields.h"
#include "pcd_format.h"
#include "separated_text.h"
#include "text.h"
#include "text_rows.h"

namespace pcl_bv::detail {
namespace {

template <typename Named>
std::vector<std::size_t> coordinate_columns(const Named& names) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (is_coordinate_name(names[i])) found.push_back(i);
  return found;
}

// What is known of the columns before the first line of numbers.
struct KnownColumns {
  std::vector<std::size_t> coordinates;  // numbers of the columns x, y and z
  std::size_t count = 0;
  char separator = ' ';  // between the names
  bool certain = false;  // a comment may be no header
};

bool is_number(std::string_view word) {
  double value = 0;
  return read_number(word, value);
}

// Returns whether x, y and z are numbers, since other columns may have text. Without names, all values must
// be numbers.
bool is_row_of_numbers(const Words& words, const KnownColumns& known) {
  const bool named = known.coordinates.size() >= 3 && (known.certain || words.size() == known.count);
  if (!named) return !words.empty() && std::all_of(words.begin(), words.end(), is_number);
  return std::all_of(known.coordinates.begin(), known.coordinates.end(),
                     [&](std::size_t i) { return i < words.size() && is_number(words[i]); });
}

constexpr char kSeparators[] = {';', ',', ' '};

// Returns the separator with which a line is a row of numbers, or nullopt. That of the names comes first,
// because text in a column may have another one.
std::optional<char> separator_of_row(std::string_view line, const KnownColumns& known) {
  const auto fits = [&](char separator) {
    return (separator == ' ' || line.find(separator) != std::string_view::npos) &&
           is_row_of_numbers(split_columns(line, separator), known);
  };
  if (known.separator != ' ' && fits(known.separator)) return known.separator;
  const auto* const found = std::find_if(std::begin(kSeparators), std::end(kSeparators), fits);
  return found == std::end(kSeparators) ? std::nullopt : std::optional(*found);
}

char separator_of_names(std::string_view header) {
  for (const char separator : kSeparators)
    if (coordinate_columns(split_columns(header, separator)).size() >= 3) return separator;
  return separator_of(header);
}

KnownColumns columns_of_header(std::string_view header, bool is_comment) {
  KnownColumns known;
  known.separator = separator_of_names(header);
  const Words names = split_columns(header, known.separator);
  known.coordinates = coordinate_columns(names);
  known.count = names.size();
  known.certain = !is_comment;
  return known;
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
  std::size_t begin = 0;              // of the first line of numbers
  std::size_t columns = 0;            // in this line
  char separator = ' ';               // in this line
  std::optional<double> point_count;  // alone in a line, as in .pts files
  std::string_view header;            // the last line that is not blank before it, without # and //
  KnownColumns known;                 // from the header
  bool header_is_comment = false;
};

// Returns whether the line is a number alone.
bool is_count(std::string_view line) {
  return split(line).size() == 1 && is_number(line);
}

void set_first_row(std::string_view line, char separator, std::size_t expected_columns, TextStart& start) {
  start.separator = separator;
  start.columns = split_columns(line, separator).size();
  // Empty values at the end count if the columns have names.
  if (start.columns < expected_columns && expected_columns <= split_all_columns(line, separator).size())
    start.columns = expected_columns;
}

// Returns nothing if the numbers begin behind the text. `names` are those of --columns, if given.
std::optional<TextStart> find_numbers(std::string_view text, bool more, const KnownColumns& names) {
  TextStart start;
  bool other_text = false;
  for (std::size_t at = text.starts_with("\xEF\xBB\xBF") ? 3 : 0; at < text.size();) {
    const std::size_t newline = text.find('\n', at);
    if (newline == std::string_view::npos && more) return std::nullopt;
    const std::size_t end = std::min(newline, text.size());
    const std::string_view line = without_blanks_around(text.substr(at, end - at));
    const std::size_t begin = std::exchange(at, end + 1);
    if (line.empty()) continue;
    if (!start.point_count && (more || at < text.size()) && is_count(line)) {
      read_number(line, start.point_count.emplace());
      continue;
    }
    const KnownColumns& known = names.certain ? names : start.known;
    if (const std::optional<char> separator = separator_of_row(line, known)) {
      set_first_row(line, *separator, known.count, start);
      start.begin = begin;
      return start;
    }
    const std::size_t comment = line.find_first_not_of("#/");
    start.header_is_comment = comment != 0;
    if (!start.header_is_comment && std::exchange(other_text, true))
      throw IoError("line " + in_quotes(line) + " is neither numbers nor a header");
    start.header = comment == std::string_view::npos ? std::string_view() : line.substr(comment);
    if (!start.known.certain) start.known = columns_of_header(start.header, start.header_is_comment);
  }
  if (!more) throw IoError("has no line of numbers");
  return std::nullopt;
}

void add_named_columns(const TextStart& start, RawCloud& cloud) {
  Words names = split_columns(start.header, separator_of_names(start.header));
  if (names.size() != start.columns) names = split_columns(start.header, start.separator);
  const bool fits = names.size() == start.columns;
  if (!fits && !start.header.empty() && !start.header_is_comment)
    throw IoError("the header has " + std::to_string(names.size()) +
                  " names, the first line of numbers has " + std::to_string(start.columns) + " values");
  for (std::size_t i = 0; i < start.columns; ++i) {
    std::string name = default_column_name(i, start.columns);
    if (fits) {
      name = names[i].empty() ? "field" + std::to_string(i + 1) : names[i];
      std::replace_if(
          name.begin(), name.end(), [](char c) { return c == ' ' || c == '\t'; }, '_');
    }
    if (!is_word(name)) throw IoError("column " + std::to_string(i + 1) + " has no name in the header");
    append_field({std::move(name), 'F', 8, 1, 0}, cloud);
  }
}

void compare_counts(const std::optional<double>& stated, RawCloud& cloud) {
  if (!stated || *stated == static_cast<double>(cloud.width)) return;
  add_note(cloud, "the line before the points says " + general_text(*stated, 17) + " points, the file has " +
                      std::to_string(cloud.width));
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
  const std::vector<PointField> given = columns.empty() ? std::vector<PointField>() : parse_columns(columns);
  std::vector<std::string_view> names;
  for (const PointField& field : given)
    names.push_back(field.name);
  const KnownColumns known{coordinate_columns(names), names.size(), ' ', !given.empty()};
  std::optional<double> point_count;
  parse_header(file, "line of numbers", [&](std::string_view text, bool more) {
    const std::optional<TextStart> start = find_numbers(text, more, known);
    if (!start) return false;
    if (start->columns > kMaxColumns) throw IoError("more than 4096 columns");
    header.data_offset = start->begin;
    header.separator = start->separator;
    point_count = start->point_count;
    if (given.empty()) {
      add_named_columns(*start, cloud);
    } else {
      for (const PointField& field : given)
        append_field(field, cloud);
      if (given.size() != start->columns)
        throw IoError("the first line of numbers has " + std::to_string(start->columns) +
                      " values, not the " + std::to_string(given.size()) + " of --columns");
    }
    return true;
  });
  TextBody body{file, header.data_offset, false, header.separator};
  cloud.width = skip_text_rows(body, static_cast<std::size_t>(-1));
  compare_counts(point_count, cloud);
  require_coordinates(cloud);
  return header;
}

}  // namespace pcl_bv::detail
