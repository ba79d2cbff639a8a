// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Every error names its row.
#include "pcd_ascii.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>

#include "element_type.h"
#include "header_words.h"
#include "pcl_bv/io/io_error.h"
#include "text_rows.h"

namespace pcl_bv {
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

class AsciiReader {
 public:
  AsciiReader(std::string_view text, RawCloud& cloud)
      : rows_(text), cloud_(cloud), values_(values_per_point(cloud)) {}

  void read() {
    cloud_.data.resize(cloud_.size() * cloud_.point_step);
    for (row_ = 1; row_ <= cloud_.size(); ++row_)
      read_row(&cloud_.data[(row_ - 1) * cloud_.point_step]);
    if (rows_.find_row()) throw IoError("more rows than the " + std::to_string(cloud_.size()) + " POINTS");
  }

 private:
  void read_row(std::byte* to) {
    if (!rows_.find_row()) fail("truncated: row ", " is missing, of " + std::to_string(cloud_.size()));
    std::size_t read = 0;
    for (const PointField& field : cloud_.fields) {
      for (std::uint32_t i = 0; i < field.count; ++i, ++read, to += field.size) {
        if (!rows_.find_value()) {
          fail("truncated: row ",
               " has " + std::to_string(read) + " values instead of " + std::to_string(values_));
        }
        if (rows_.read(field, to)) continue;
        fail("row ", ", field " + in_quotes(field.name) + ": " + in_quotes(rows_.value()) +
                         " is not a number of TYPE " + field.type + ", SIZE " + std::to_string(field.size));
      }
    }
    if (rows_.find_value()) fail("row ", " has more than " + std::to_string(values_) + " values");
  }

  [[noreturn]] void fail(const char* before, const std::string& after) const {
    throw IoError(before + std::to_string(row_) + after);
  }

  TextRows rows_;
  RawCloud& cloud_;
  std::size_t values_;
  std::size_t row_ = 0;
};

template <typename T>
bool is_nan(T value) {
  if constexpr (std::is_floating_point_v<T>) return std::isnan(value);
  return false;
}

template <typename T>
void append_number(std::string& text, T value) {
  if (is_nan(value)) {
    text += "nan";
    return;
  }
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

}  // namespace

void read_ascii_points(const InputFile& file, std::size_t offset, RawCloud& cloud) {
  check_types(cloud);
  const std::size_t available = file.size() - offset;
  // A value takes a digit and a separator, which only the last one of the file may lack.
  const std::size_t values = std::max<std::size_t>(values_per_point(cloud), 1);
  if (cloud.size() > (available + 1) / (2 * values)) {
    throw IoError("truncated: " + std::to_string(cloud.size()) + " points of " +
                  std::to_string(values_per_point(cloud)) + " values do not fit in the " +
                  std::to_string(available) + " bytes after the header");
  }
  std::string text(available, '\0');
  file.read(offset, text.data(), text.size());
  AsciiReader(text, cloud).read();
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
          append_number(text, value);
        });
        text += ' ';
      }
    }
    text.back() = '\n';
  }
  return text;
}

}  // namespace pcl_bv
