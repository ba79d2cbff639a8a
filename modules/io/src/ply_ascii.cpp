// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "invalid_values.h"
#include "ply_format.h"
#include "text_rows.h"

namespace pcl_bv::detail {
namespace {

// Reads one vertex. Successive properties of the same type are read as one run.
class VertexRow {
 public:
  VertexRow(const PlyElement& vertex, InvalidValues& invalid_values)
      : vertex_(vertex), invalid_values_(invalid_values) {
    for (const PlyProperty& property : vertex.properties) {
      const bool follows = !property.is_list && !steps_.empty() && !steps_.back().is_list;
      if (!follows || !extend_run(steps_.back().value, property.value)) steps_.push_back(property);
    }
  }

  void operator()(TextRows& rows, std::byte* to) const {
    const PlyProperty* property = vertex_.properties.data();
    std::size_t field = 0;
    for (const PlyProperty& step : steps_) {
      if (step.is_list) {
        skip_list(rows, *property++);
        continue;
      }
      rows.read_all(step.value, to, [&](std::uint32_t found, std::byte* at) {
        if (!invalid_values_.replace_value(rows, field + found, at)) refuse(rows, property[found].value);
      });
      property += step.value.count;
      field += step.value.count;
      to += step.value.bytes();
    }
    if (rows.find_value()) throw RowError{"vertex ", " has more values than properties"};
  }

 private:
  static void skip_list(TextRows& rows, const PlyProperty& list) {
    std::uint64_t n = 0;  // a count of a smaller unsigned type fills the low bytes (little-endian)
    PointField count = list.count;
    count.type = 'U';
    count.count = 1;
    if (rows.read(count, reinterpret_cast<std::byte*>(&n)) == 0) refuse(rows, list.count);
    for (; n > 0; --n) {
      if (!rows.find_value()) refuse(rows, list.value);
      rows.skip_value();
    }
  }

  // Throws the error for a value at the cursor that is missing or not of this type.
  [[noreturn]] static void refuse(TextRows& rows, const PointField& value) {
    if (!rows.find_value()) {
      throw RowError{"truncated: vertex ", " has no more values for property " + in_quotes(value.name)};
    }
    throw RowError{"vertex ", ", property " + in_quotes(value.name) + ": " + in_quotes(rows.value()) +
                                  " is not of type " + std::string(ply_type_name(value))};
  }

  const PlyElement& vertex_;
  InvalidValues& invalid_values_;
  std::vector<PlyProperty> steps_;
};

void skip(TextBody& body, const PlyElement& element) {
  if (element.properties.empty()) return;
  if (element.count == 0) return;
  const std::size_t found = skip_text_rows(body, element.count);
  if (found == element.count) return;
  throw IoError("truncated: row " + std::to_string(found) + " of element " + in_quotes(element.name) +
                " is missing, of " + std::to_string(element.count));
}

}  // namespace

void read_ply_ascii(const InputFile& file, PlyHeader& header, const ParallelPolicy& policy) {
  RawCloud& cloud = header.cloud;
  const std::size_t available = file.size() - header.data_offset;
  const std::size_t values = std::max<std::size_t>(header.vertex.properties.size(), 1);
  // Each value takes at least a digit and a separator. Only the last value of the file may have no separator.
  if (cloud.size() > (available + 1) / (2 * values)) {
    throw IoError("truncated: " + std::to_string(cloud.size()) + " vertices of " + std::to_string(values) +
                  " properties do not fit in the " + std::to_string(available) + " bytes after the header");
  }
  // A carriage return alone also ends a row. If a line feed follows the carriage return, the text between
  // these two characters is a blank row, which is ignored.
  TextBody body{file, header.data_offset, true};
  for (const PlyElement& element : header.skipped)
    skip(body, element);
  cloud.data.resize(cloud.size() * cloud.point_step);
  InvalidValues invalid_values(cloud, "vertex", 0);
  const RowsRead rows = read_text_rows(body, {0, cloud.size(), cloud.point_step},
                                       VertexRow(header.vertex, invalid_values), cloud.data.data(), policy);
  if (rows.count < cloud.size()) {
    throw IoError("truncated: vertex " + std::to_string(rows.count) + " is missing, of " +
                  std::to_string(cloud.size()));
  }
  if (header.vertices_are_last && rows.more) {
    throw IoError("more rows than the " + std::to_string(cloud.size()) + " vertices");
  }
  invalid_values.report(cloud);
}

}  // namespace pcl_bv::detail
