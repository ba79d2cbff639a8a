// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// See sample_plys.h.
#include "sample_plys.h"

#include <algorithm>
#include <cstring>
#include <sstream>

namespace pcl_bv {
using namespace detail;
namespace {

std::string type_name(const PointField& field) {
  if (field.type == 'F') return field.size == 4 ? "float" : "float64";
  const std::string name = field.size == 1 ? "char" : field.size == 2 ? "int16" : "int";
  if (field.type == 'I') return name;
  return name == "int16" ? "ushort" : "u" + name;
}

/// Values in the format of the style, one after another.
class Body {
 public:
  explicit Body(const PlyStyle& style) : style_(style) { text_.precision(17); }

  template <typename T>
  void add(T value) {
    if (style_.format == "ascii") {
      text_ << (row_begins_ ? "" : " ") << +value;
      row_begins_ = false;
      return;
    }
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    if (style_.format == "binary_big_endian") std::reverse(bytes, bytes + sizeof value);
    text_.write(bytes, sizeof value);
  }

  template <typename T>
  void add_stored(const std::byte* from) {
    T value;
    std::memcpy(&value, from, sizeof value);
    add(value);
  }

  void add_field(const PointField& field, const std::byte* from) {
    const bool is_signed = field.type == 'I';
    if (field.type == 'F') return field.size == 4 ? add_stored<float>(from) : add_stored<double>(from);
    if (field.size == 1) return is_signed ? add_stored<std::int8_t>(from) : add_stored<std::uint8_t>(from);
    if (field.size == 2) return is_signed ? add_stored<std::int16_t>(from) : add_stored<std::uint16_t>(from);
    return is_signed ? add_stored<std::int32_t>(from) : add_stored<std::uint32_t>(from);
  }

  void end_row() {
    if (style_.format == "ascii") text_ << style_.newline;
    row_begins_ = true;
  }

  void add_faces() {
    for (const int corners : {3, 0, 4}) {
      add(static_cast<std::uint8_t>(corners));
      for (int i = 0; i < corners; ++i)
        add(std::int32_t{i});
      add(0.5f);
      end_row();
    }
  }

  std::string text() const { return text_.str(); }

 private:
  const PlyStyle& style_;
  std::ostringstream text_;
  bool row_begins_ = true;
};

const char faces[] = "element face 3\nproperty list uchar int vertex_indices\nproperty float quality\n";

std::string header(const RawCloud& cloud, const PlyStyle& style) {
  std::string text = "ply\nformat " + style.format + " 1.0\ncomment made by a test\nobj_info x y z\n";
  if (style.elements_before)
    text += faces + std::string("element none 7\nelement camera 1\nproperty double x\n");
  text += "element vertex " + std::to_string(cloud.size()) + "\n";
  for (std::size_t f = 0; f < cloud.fields.size(); ++f) {
    if (style.list_inside && f == 1) text += "property list ushort short odd\n";
    text += "property " + type_name(cloud.fields[f]) + " " + cloud.fields[f].name + "\n";
  }
  if (style.elements_after) text += faces;
  text += "end_header\n";
  std::string with_newlines;
  for (const char c : text)
    with_newlines += c == '\n' ? style.newline : std::string(1, c);
  return with_newlines;
}

}  // namespace

const std::vector<PlyStyle>& ply_styles() {
  static const std::vector<PlyStyle> styles = [] {
    std::vector<PlyStyle> all;
    for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
      for (const char* newline : {"\n", "\r\n", "\r"}) {
        for (int flags = 0; flags < 8; ++flags)
          all.push_back({format, (flags & 1) != 0, (flags & 2) != 0, (flags & 4) != 0, newline});
      }
    }
    return all;
  }();
  return styles;
}

const std::vector<Layout>& ply_layouts() {
  static const std::vector<Layout> layouts = {
      {"xyz", {{"x"}, {"y"}, {"z"}}},
      {"colours", {{"x"}, {"y"}, {"z"}, {"red", 'U', 1}, {"green", 'U', 1}, {"blue", 'U', 1}}},
      {"x_at_an_offset", {{"nx"}, {"ring", 'U', 2}, {"x"}, {"y"}, {"z"}}},
      {"z_y_x", {{"z"}, {"y"}, {"x"}}},
      {"doubles", {{"x", 'F', 8}, {"y", 'F', 8}, {"z", 'F', 8}, {"intensity"}}},
      {"doubles_apart", {{"y", 'F', 8}, {"a", 'I', 1}, {"x", 'F', 8}, {"z", 'F', 8}}},
      {"every_type",
       {{"i1", 'I', 1},
        {"u1", 'U', 1},
        {"i2", 'I', 2},
        {"u2", 'U', 2},
        {"i4", 'I', 4},
        {"u4", 'U', 4},
        {"f8", 'F', 8},
        {"x"},
        {"y"},
        {"z"}}}};
  return layouts;
}

RawCloud ply_cloud(const Layout& layout, std::size_t points, std::uint32_t seed) {
  RawCloud cloud = sample_cloud(layout, points, 1, seed);
  cloud.viewpoint = RawCloud().viewpoint;
  return cloud;
}

std::string ply_text(const RawCloud& cloud, const PlyStyle& style) {
  Body body(style);
  if (style.elements_before) {
    body.add_faces();
    body.add(2.5);
    body.end_row();
  }
  for (std::size_t point = 0; point < cloud.size(); ++point) {
    for (std::size_t f = 0; f < cloud.fields.size(); ++f) {
      if (style.list_inside && f == 1) {
        body.add(static_cast<std::uint16_t>(point % 3));
        for (std::size_t i = 0; i < point % 3; ++i)
          body.add(std::int16_t{-7});
      }
      body.add_field(cloud.fields[f], &cloud.data[point * cloud.point_step + cloud.fields[f].offset]);
    }
    body.end_row();
  }
  if (style.elements_after) body.add_faces();
  return header(cloud, style) + body.text();
}

std::string describe(const Layout& layout, const PlyStyle& style) {
  return layout.name + ", " + style.format + (style.elements_before ? ", before" : "") +
         (style.list_inside ? ", list" : "") + (style.elements_after ? ", after" : "") + ", line end of " +
         std::to_string(style.newline.size()) + (style.newline == "\r" ? " (old)" : "");
}

}  // namespace pcl_bv
