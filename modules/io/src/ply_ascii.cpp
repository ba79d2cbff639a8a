// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A row of text for each vertex; every error names the vertex.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>

#include "header_words.h"
#include "pcl_bv/io/io_error.h"
#include "ply_vertices.h"
#include "text_rows.h"

namespace pcl_bv {
namespace {

class VertexRows {
 public:
  VertexRows(std::string_view text, PlyHeader& header) : rows_(text), header_(header) {}

  void read() {
    for (const PlyElement& element : header_.skipped)
      skip(element);
    RawCloud& cloud = header_.cloud;
    cloud.data.resize(cloud.size() * cloud.point_step);
    for (vertex_ = 0; vertex_ < cloud.size(); ++vertex_)
      read_vertex(&cloud.data[vertex_ * cloud.point_step]);
    if (header_.vertices_are_last && rows_.find_row()) {
      throw IoError("more rows than the " + std::to_string(cloud.size()) + " vertices");
    }
  }

 private:
  void skip(const PlyElement& element) {
    if (element.properties.empty()) return;
    for (std::size_t i = 0; i < element.count; ++i) {
      if (!rows_.find_row()) {
        throw IoError("truncated: row " + std::to_string(i) + " of element " + in_quotes(element.name) +
                      " is missing, of " + std::to_string(element.count));
      }
      rows_.skip_row();
    }
  }

  void read_vertex(std::byte* to) {
    if (!rows_.find_row()) throw IoError("truncated: " + here() + " is missing, of " + count());
    for (const PlyProperty& property : header_.vertex.properties) {
      if (property.is_list) {
        skip_list(property);
      } else {
        read_value(property.value, to);
        to += property.value.size;
      }
    }
    if (rows_.find_value()) throw IoError(here() + " has more values than properties");
  }

  void read_value(const PointField& value, std::byte* to) {
    need_value(value);
    if (!rows_.read(value, to)) refuse_value(value);
  }

  void skip_list(const PlyProperty& list) {
    std::uint64_t n = 0;  // little-endian, and not negative: a smaller element fills its low bytes
    PointField count = list.count;
    count.type = 'U';
    read_value(count, reinterpret_cast<std::byte*>(&n));
    for (; n > 0; --n) {
      need_value(list.value);
      rows_.skip_value();
    }
  }

  void need_value(const PointField& value) {
    if (rows_.find_value()) return;
    throw IoError("truncated: " + here() + " has no more values for property " + in_quotes(value.name));
  }

  [[noreturn]] void refuse_value(const PointField& value) const {
    throw IoError(here() + ", property " + in_quotes(value.name) + ": " + in_quotes(rows_.value()) +
                  " is not of type " + std::string(ply_type_name(value)));
  }

  std::string here() const { return "vertex " + std::to_string(vertex_); }
  std::string count() const { return std::to_string(header_.cloud.size()); }

  TextRows rows_;
  PlyHeader& header_;
  std::size_t vertex_ = 0;
};

}  // namespace

void read_ply_ascii(const InputFile& file, PlyHeader& header) {
  const std::size_t available = file.size() - header.data_offset;
  const std::size_t values = header.vertex.properties.size();
  // A value takes a digit and a separator, which only the last one of the file may lack.
  if (header.cloud.size() > (available + 1) / (2 * values)) {
    throw IoError("truncated: " + std::to_string(header.cloud.size()) + " vertices of " +
                  std::to_string(values) + " properties do not fit in the " + std::to_string(available) +
                  " bytes after the header");
  }
  std::string text(available, '\0');
  file.read(header.data_offset, text.data(), text.size());
  std::replace(text.begin(), text.end(), '\r', '\n');  // alone it ends lines too; empty ones do not count
  VertexRows(text, header).read();
}

}  // namespace pcl_bv
