// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "fields.h"
#include "invalid_values.h"
#include "pcd_format.h"
#include "text.h"
#include "text_rows.h"

namespace pcl_bv::detail {
namespace {

void check_types(const RawCloud& cloud) {
  for (const PointField& field : cloud.fields) {
    if (field.type == 'F' && field.size < 4) {
      throw IoError("field " + in_quotes(field.name) + " of TYPE F, SIZE " + std::to_string(field.size) +
                    " is not supported in ascii");
    }
  }
}

std::size_t values_per_point(const RawCloud& cloud) {
  std::size_t values = 0;
  for (const PointField& field : cloud.fields)
    values += field.count;
  return values;
}

// Reads one row. Successive fields of the same type are read as one run.
class PointRow {
 public:
  PointRow(const RawCloud& cloud, InvalidValues& invalid_values)
      : cloud_(cloud), invalid_values_(invalid_values) {
    for (const PointField& field : cloud.fields) {
      if (runs_.empty() || !extend_run(runs_.back(), field)) runs_.push_back(field);
    }
  }

  void operator()(TextRows& rows, std::byte* to) const {
    std::size_t read = 0;
    for (const PointField& run : runs_) {
      rows.read_all(run, to,
                    [&](std::uint32_t found, std::byte* at) { replace_value(rows, read + found, at); });
      read += run.count;
      to += run.bytes();
    }
    if (rows.find_value()) {
      throw RowError{"row ", " has more than " + std::to_string(values_per_point(cloud_)) + " values"};
    }
  }

 private:
  // Handles value number `read` of the row, counted from 0. The value is missing or not a number of the
  // field's type.
  void replace_value(TextRows& rows, std::size_t read, std::byte* at) const {
    if (!rows.find_value()) {
      throw RowError{"truncated: row ", " has " + std::to_string(read) + " values instead of " +
                                            std::to_string(values_per_point(cloud_))};
    }
    std::size_t number = 0;
    for (; read >= cloud_.fields[number].count; ++number)
      read -= cloud_.fields[number].count;
    if (invalid_values_.replace_value(rows, number, at)) return;
    const PointField& field = cloud_.fields[number];
    throw RowError{"row ", ", field " + in_quotes(field.name) + ": " + rows.quoted_value() +
                               " is not a number of TYPE " + field.type + ", SIZE " +
                               std::to_string(field.size)};
  }

  const RawCloud& cloud_;
  InvalidValues& invalid_values_;
  std::vector<PointField> runs_;
};

}  // namespace

void read_ascii_points(const InputFile& file, PcdHeader& header, const ParallelPolicy& policy) {
  RawCloud& cloud = header.cloud;
  check_types(cloud);
  const std::size_t available = file.size() - header.data_offset;
  // Each value takes at least a digit and a separator. Only the last value of the file may have no separator.
  // Values between commas or semicolons may be empty.
  const std::size_t values = std::max<std::size_t>(values_per_point(cloud), 1);
  const std::size_t value_bytes = header.separator == ' ' ? 2 : 1;
  if (cloud.size() > (available + 1) / (value_bytes * values)) {
    throw IoError("truncated: " + std::to_string(cloud.size()) + " points of " + std::to_string(values) +
                  " values do not fit in the " + std::to_string(available) + " bytes after the header");
  }
  cloud.data.resize(cloud.size() * cloud.point_step);
  InvalidValues invalid_values(cloud, "row", 1);
  TextBody body{file, header.data_offset, false, header.separator};
  body.columns = values;
  const RowsRead rows = read_text_rows(body, {1, cloud.size(), cloud.point_step},
                                       PointRow(cloud, invalid_values), cloud.data.data(), policy);
  if (rows.count < cloud.size()) {
    throw IoError("truncated: row " + std::to_string(rows.count + 1) + " is missing, of " +
                  std::to_string(cloud.size()));
  }
  if (rows.more) throw IoError("more rows than the " + std::to_string(cloud.size()) + " POINTS");
  invalid_values.report(cloud);
}

std::string format_ascii_points(const RawCloud& cloud) {
  check_types(cloud);
  std::string text;
  const std::byte* at = cloud.data.data();
  for (std::size_t row = 0; row < cloud.size(); ++row) {
    for (const PointField& field : cloud.fields) {
      for (std::uint32_t i = 0; i < field.count; ++i, at += field.size) {
        with_element_type(field, [&](auto value) {
          std::memcpy(&value, at, sizeof value);
          if (std::isnan(static_cast<double>(value))) {
            text += "nan";  // without sign and payload
          } else {
            append_number(text, value);
          }
        });
        text += ' ';
      }
    }
    text.back() = '\n';
  }
  return text;
}

}  // namespace pcl_bv::detail
