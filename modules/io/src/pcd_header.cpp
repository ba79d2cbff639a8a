// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

#include "fields.h"
#include "pcd_format.h"
#include "text.h"
#include "trailing_points.h"

namespace pcl_bv::detail {
namespace {

using KeywordLines = std::map<std::string_view, Words>;  // keyword -> the words after it

constexpr std::string_view keywords[] = {"VERSION", "FIELDS", "SIZE",      "TYPE",   "COUNT",
                                         "WIDTH",   "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};

// Adds the words of a line to `lines`. Returns the line's keyword. For a comment or an empty line, returns an
// empty text.
std::string_view add_line(std::string_view line, KeywordLines& lines) {
  Words words = split(line);
  if (words.empty() || words[0][0] == '#') return {};
  const std::string_view keyword = words[0] == "COLUMNS" ? std::string_view("FIELDS") : words[0];
  if (std::find(std::begin(keywords), std::end(keywords), keyword) == std::end(keywords)) {
    throw IoError("not a .pcd file: unknown header line " + in_quotes(line));
  }
  words.erase(words.begin());
  if (!lines.emplace(keyword, std::move(words)).second) {
    throw IoError("header: " + std::string(keyword) + " occurs twice");
  }
  return keyword;
}

// Returns whether the text begins with a line DATA. Some recorders write this line twice when they rewrite
// the header. Then all points would be read from a wrong offset. Real points never begin with such a line.
bool begins_with_data_line(std::string_view text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  const Words words = split(line);
  return line.size() < text.size() && words.size() == 2 && words[0] == "DATA" &&
         std::find(pcd_encoding_names.begin(), pcd_encoding_names.end(), words[1]) !=
             pcd_encoding_names.end();
}

// Collects the header lines up to and including the line DATA. Returns false if there is no such line in
// `start`. `more` is whether the file is longer than `start`.
bool collect_header_lines(std::string_view start, bool more, KeywordLines& lines, std::size_t& data_offset) {
  std::size_t at = 0;
  while (at < start.size()) {
    const std::size_t newline = start.find('\n', at);
    const std::size_t end = std::min(newline, start.size());
    const std::string_view line = start.substr(at, end - at);
    // An incomplete line is interpreted only if the file ends with this line, and if the line is a line DATA
    // or no keyword comes before it.
    if (newline == std::string_view::npos && (more || (!lines.empty() && !line.starts_with("DATA"))))
      return false;
    const std::string_view keyword = add_line(line, lines);
    at = std::min(end + 1, start.size());
    if (keyword == "DATA") {
      data_offset = at;
      if (begins_with_data_line(start.substr(at))) throw IoError("header: DATA occurs twice");
      return true;
    }
  }
  return false;
}

const Words& words_of(const KeywordLines& lines, std::string_view keyword, std::size_t count) {
  const auto line = lines.find(keyword);
  if (line == lines.end()) throw IoError("header: no " + std::string(keyword) + " line");
  if (line->second.size() != count) {
    throw IoError("header: " + std::string(keyword) + " has " + std::to_string(line->second.size()) +
                  " entries, expected " + std::to_string(count));
  }
  return line->second;
}

template <typename T>
T number(std::string_view keyword, std::string_view word, const char* expected) {
  T value{};
  if (!read_number(word, value)) {
    throw IoError("header: " + std::string(keyword) + ": " + in_quotes(word) + " is not " + expected);
  }
  return value;
}

std::uint32_t element_size(std::string_view word) {
  if (word == "1" || word == "2" || word == "4" || word == "8")
    return static_cast<std::uint32_t>(word[0] - '0');
  throw IoError("header: SIZE: " + in_quotes(word) + " is not one of 1, 2, 4, 8");
}

char element_type(std::string_view word) {
  if (word == "I" || word == "U" || word == "F") return word[0];
  throw IoError("header: TYPE: " + in_quotes(word) + " is not one of I, U, F");
}

// Returns the number of elements. 0 is allowed for fields other than coordinates, which then have no bytes.
std::uint32_t element_count(std::string_view word, std::string_view field) {
  const char expected[] = "a number from 1 to 4294967295";
  const auto count = number<std::uint32_t>("COUNT", word, expected);
  if (count == 0 && is_coordinate_name(field))
    throw IoError("header: COUNT: " + in_quotes(word) + " is not " + expected);
  return count;
}

void read_fields(const KeywordLines& lines, RawCloud& cloud) {
  const auto names = lines.find("FIELDS");
  if (names == lines.end() || names->second.empty()) return;
  const std::size_t n = names->second.size();
  const Words& sizes = words_of(lines, "SIZE", n);
  const Words& types = words_of(lines, "TYPE", n);
  const Words counts = lines.count("COUNT") ? words_of(lines, "COUNT", n) : Words(n, "1");
  for (std::size_t i = 0; i < n; ++i) {
    const std::string_view name = names->second[i];
    const std::uint32_t count = element_count(counts[i], name);
    if (count == 0) {
      add_note(cloud, "field " + in_quotes(name) + " has COUNT 0 and is left out");
      continue;
    }
    append_field({std::string(name), element_type(types[i]), element_size(sizes[i]), count, 0}, cloud);
  }
}

void read_shape(const KeywordLines& lines, RawCloud& cloud) {
  const auto value = [&](std::string_view keyword) {
    return number<std::size_t>(keyword, words_of(lines, keyword, 1)[0], "a number of points");
  };
  if (!lines.count("WIDTH") && !lines.count("POINTS")) throw IoError("header: neither WIDTH nor POINTS");
  cloud.height = lines.count("HEIGHT") ? value("HEIGHT") : 1;
  cloud.width = lines.count("WIDTH") ? value("WIDTH") : value("POINTS");
  constexpr std::size_t max_size = std::numeric_limits<std::size_t>::max();
  const std::size_t step = std::max<std::size_t>(cloud.point_step, 1);
  if (cloud.height != 0 && cloud.width > max_size / cloud.height / step) {
    throw IoError("header: " + std::to_string(cloud.width) + " x " + std::to_string(cloud.height) +
                  " points of " + std::to_string(cloud.point_step) + " bytes are more than a file can hold");
  }
  if (lines.count("POINTS") && value("POINTS") != cloud.size()) {
    throw IoError("header: " + std::to_string(value("POINTS")) + " POINTS, but WIDTH x HEIGHT is " +
                  std::to_string(cloud.width) + " x " + std::to_string(cloud.height));
  }
}

void read_viewpoint(const KeywordLines& lines, RawCloud& cloud) {
  if (!lines.count("VIEWPOINT")) return;
  const Words& words = words_of(lines, "VIEWPOINT", 7);
  std::transform(words.begin(), words.end(), cloud.viewpoint.begin(),
                 [](std::string_view word) { return number<double>("VIEWPOINT", word, "a number"); });
  if (is_not_identity(cloud.viewpoint))
    add_note(cloud, "VIEWPOINT is not the identity and is not applied: coordinates are taken as stored");
}

void check_version(const KeywordLines& lines) {
  if (!lines.count("VERSION")) return;
  const std::string_view version = words_of(lines, "VERSION", 1)[0];
  for (const char* known : {".7", "0.7", ".6", "0.6", ".5", "0.5"}) {
    if (version == known) return;
  }
  throw IoError("header: VERSION " + in_quotes(version) + " is not supported, only up to 0.7");
}

PcdEncoding read_encoding(const KeywordLines& lines) {
  const std::string_view word = words_of(lines, "DATA", 1)[0];
  const auto* const name = std::find(pcd_encoding_names.begin(), pcd_encoding_names.end(), word);
  if (name != pcd_encoding_names.end()) return static_cast<PcdEncoding>(name - pcd_encoding_names.begin());
  throw IoError("header: DATA: " + in_quotes(word) + " is not one of ascii, binary, binary_compressed");
}

}  // namespace

PcdHeader read_pcd_header(const InputFile& file) {
  PcdHeader header;
  parse_header(file, "DATA line", [&](std::string_view start, bool more) {
    KeywordLines lines;
    if (!collect_header_lines(start, more, lines, header.data_offset)) return false;
    check_version(lines);
    header.encoding = read_encoding(lines);
    read_fields(lines, header.cloud);
    read_shape(lines, header.cloud);
    if (header.cloud.fields.empty() && header.cloud.size() > 0) throw IoError("header: no FIELDS");
    require_coordinates(header.cloud);
    read_viewpoint(lines, header.cloud);
    return true;
  });
  return header;
}

void require_records(const InputFile& file, PcdHeader& header) {
  RawCloud& cloud = header.cloud;
  const std::size_t needed = cloud.size() * cloud.point_step;
  const std::size_t available = file.size() - header.data_offset;
  const std::size_t end = header.data_offset + needed;
  if (needed <= available) return note_trailing_points(file, {end, file.size()}, cloud.point_step, cloud);
  throw IoError("truncated: " + std::to_string(cloud.size()) + " points of " +
                std::to_string(cloud.point_step) + " bytes need " + std::to_string(needed) +
                " bytes, the file has " + std::to_string(available));
}

}  // namespace pcl_bv::detail
