// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <limits>
#include <optional>

#include "fields.h"
#include "ply_format.h"
#include "text.h"

namespace pcl_bv::detail {
namespace {

struct TypeName {
  std::string_view name;
  char type;
  std::uint32_t size;
};

constexpr TypeName type_names[] = {
    {"char", 'I', 1},    {"uchar", 'U', 1},  {"short", 'I', 2},  {"ushort", 'U', 2}, {"int", 'I', 4},
    {"uint", 'U', 4},    {"float", 'F', 4},  {"double", 'F', 8}, {"int8", 'I', 1},   {"uint8", 'U', 1},
    {"int16", 'I', 2},   {"uint16", 'U', 2}, {"int32", 'I', 4},  {"uint32", 'U', 4}, {"float32", 'F', 4},
    {"float64", 'F', 8}, {"int64", 'I', 8},  {"uint64", 'U', 8}};

PointField field_of(std::string_view type, std::string_view name) {
  for (const TypeName& known : type_names) {
    if (known.name == type) return {std::string(name), known.type, known.size, 1, 0};
  }
  throw IoError("header: unknown property type " + in_quotes(type));
}

[[noreturn]] void refuse(std::string_view line) {
  throw IoError("header: invalid line " + in_quotes(line));
}

/// The lines of a header. All lines end like the first line, which ends in "\n", in "\r\n", or in "\r" alone.
class Lines {
 public:
  explicit Lines(std::string_view start) : start_(start) {
    const std::size_t end = start.find_first_of("\r\n");
    if (end == std::string_view::npos || start[end] == '\n') return;
    if (end + 1 < start.size() && start[end + 1] != '\n') newline_ = '\r';
  }

  /// Gets the next line. Returns false if no line ends in the rest of the text.
  bool next(std::string_view& line) {
    const std::size_t newline = start_.find(newline_, at_);
    if (newline == std::string_view::npos) return false;
    line = start_.substr(at_, newline - at_);
    at_ = newline + 1;
    return true;
  }

  std::size_t offset() const { return at_; }

 private:
  std::string_view start_;
  std::size_t at_ = 0;
  char newline_ = '\n';
};

PlyEncoding read_format(const Words& words, std::string_view line) {
  if (words.size() != 3) refuse(line);
  if (words[2] != "1.0") throw IoError("header: format version " + in_quotes(words[2]) + " is not 1.0");
  if (words[1] == "ascii") return PlyEncoding::ascii;
  if (words[1] == "binary_little_endian") return PlyEncoding::little_endian;
  if (words[1] == "binary_big_endian") return PlyEncoding::big_endian;
  throw IoError("header: format " + in_quotes(words[1]) +
                " is not one of ascii, binary_little_endian, binary_big_endian");
}

PlyElement read_element(const Words& words, std::string_view line) {
  if (words.size() != 3) refuse(line);
  PlyElement element{std::string(words[1]), 0, {}};
  if (read_number(words[2], element.count)) return element;
  throw IoError("header: element " + in_quotes(words[1]) + ": " + in_quotes(words[2]) + " is not a number");
}

PlyProperty read_property(const Words& words, std::string_view line) {
  if (words.size() == 3) return {field_of(words[1], words[2]), {}, false};
  if (words.size() != 5 || words[1] != "list") refuse(line);
  PlyProperty list{field_of(words[3], words[4]), field_of(words[2], words[4]), true};
  if (list.count.type == 'F')
    throw IoError("header: a list cannot have " + in_quotes(words[2]) + " elements");
  return list;
}

// Returns whether a comment or obj_info states an offset of the coordinates, for which programs have keys of
// their own, such as "comment offset 500000 4200000 0". Behind the key is a number, and one number is not 0.
bool states_offset(std::string_view line) {
  std::string text;
  for (const char c : line)
    text += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a')
            : std::string_view(":=,;()[]_").find(c) != std::string_view::npos ? ' '
                                                                              : c;
  constexpr std::string_view keys[] = {"offset",      "offsetx", "offsets",     "shift",
                                       "globalshift", "shiftx",  "translation", "transform"};
  const Words words = split(text);
  const auto key = std::find_first_of(words.begin(), words.end(), std::begin(keys), std::end(keys));
  if (key == words.end()) return false;
  double number = 0;
  const auto first = std::find_if(key + 1, words.end(), [&](auto word) { return read_number(word, number); });
  return std::any_of(first, words.end(), [&](auto word) { return read_number(word, number) && number != 0; });
}

struct Contents {
  std::optional<PlyEncoding> encoding;
  std::string_view offset{};  // the first comment that states one
  std::vector<PlyElement> elements;
  std::optional<std::size_t> vertex;  // index of the first element named vertex

  /// Returns whether the last element read follows the vertices. The properties of such an element do not
  /// matter.
  bool last_follows_vertices() const { return vertex && *vertex + 1 < elements.size(); }
};

void read_line(const Words& words, std::string_view line, Contents& contents) {
  if (words[0] == "format") {
    if (contents.encoding) throw IoError("header: format occurs twice");
    contents.encoding = read_format(words, line);
  } else if (words[0] == "element") {
    contents.elements.push_back(read_element(words, line));
    if (!contents.vertex && contents.elements.back().name == "vertex")
      contents.vertex = contents.elements.size() - 1;
  } else if (words[0] == "property") {
    if (contents.elements.empty()) throw IoError("header: a property before any element");
    if (!contents.last_follows_vertices())
      contents.elements.back().properties.push_back(read_property(words, line));
  } else {
    refuse(line);
  }
}

// Parses the header. Returns false if the header does not end in `start`.
bool read_contents(std::string_view start, Contents& contents, std::size_t& data_offset) {
  Lines lines(start);
  std::string_view line;
  const bool has_line = start.starts_with("ply") && lines.next(line);
  if (!start.starts_with("ply") || (has_line && split(line) != Words{"ply"}))
    throw IoError("not a .ply file: it does not start with a line 'ply'");
  while (lines.next(line)) {
    const Words words = split(line);
    data_offset = lines.offset();
    if (words == Words{"end_header"}) return true;
    if (words.empty()) continue;
    if (words[0] != "comment" && words[0] != "obj_info") {
      read_line(words, line, contents);
    } else if (contents.offset.empty() && states_offset(line)) {
      contents.offset = line;
    }
  }
  return false;
}

void make_fields(const PlyElement& vertex, RawCloud& cloud) {
  for (const PlyProperty& property : vertex.properties) {
    if (!property.is_list) append_field(property.value, cloud);
  }
  cloud.width = vertex.count;
  require_coordinates(cloud);
  if (cloud.width > std::numeric_limits<std::size_t>::max() / cloud.point_step) {
    throw IoError("header: " + std::to_string(cloud.width) + " vertices are more than a file can hold");
  }
}

}  // namespace

bool PlyElement::has_lists() const {
  return std::any_of(properties.begin(), properties.end(), [](const auto& p) { return p.is_list; });
}

std::size_t PlyElement::fixed_bytes() const {
  std::size_t bytes = 0;
  for (const PlyProperty& property : properties)
    bytes += property.fixed_bytes();
  return bytes;
}

std::string_view ply_type_name(const PointField& value) {
  return std::find_if(
             std::begin(type_names), std::end(type_names),
             [&](const TypeName& known) { return known.type == value.type && known.size == value.size; })
      ->name;
}

PlyHeader read_ply_header(const InputFile& file) {
  Contents contents;
  PlyHeader header;
  parse_header(file, "end_header", [&](std::string_view start, bool) {
    contents = {};
    const bool complete = read_contents(start, contents, header.data_offset);
    if (complete && !contents.offset.empty())
      add_note(header.cloud, "the header has " + in_quotes(contents.offset) +
                                 ", which is not applied: coordinates are taken as stored");
    return complete;
  });
  if (!contents.encoding) throw IoError("header: no format line");
  if (!contents.vertex) throw IoError("header: no element vertex");
  const auto vertex = contents.elements.cbegin() + static_cast<std::ptrdiff_t>(*contents.vertex);
  header.encoding = *contents.encoding;
  header.skipped.assign(contents.elements.cbegin(), vertex);
  header.vertex = *vertex;
  header.vertices_are_last = vertex + 1 == contents.elements.end();
  make_fields(header.vertex, header.cloud);
  return header;
}

}  // namespace pcl_bv::detail
