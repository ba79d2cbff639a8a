// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// One pass over the text with std::from_chars; every error names its row.
#include "pcd_ascii.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>

#include "numbers.h"
#include "pcd_header.h"
#include "pcl_bv/io/io_error.h"

namespace pcl_bv {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

// Calls function with a value of the C++ type that the field's letter and size mean (see check_types).
template <typename Function>
auto with_element_type(const PointField& field, const Function& function) {
  const bool is_signed = field.type == 'I';
  switch (field.size) {
    case 1:
      return is_signed ? function(std::int8_t{}) : function(std::uint8_t{});
    case 2:
      return is_signed ? function(std::int16_t{}) : function(std::uint16_t{});
    case 4:
      if (field.type == 'F') return function(float{});
      return is_signed ? function(std::int32_t{}) : function(std::uint32_t{});
    default:
      if (field.type == 'F') return function(double{});
      return is_signed ? function(std::int64_t{}) : function(std::uint64_t{});
  }
}

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
      : at_(text.data()), end_(text.data() + text.size()), cloud_(cloud) {}

  void read() {
    cloud_.data.resize(cloud_.size() * cloud_.point_step);
    for (row_ = 1; row_ <= cloud_.size(); ++row_)
      read_row(&cloud_.data[(row_ - 1) * cloud_.point_step]);
    skip_empty_lines();
    if (at_ != end_) throw IoError("more rows than the " + std::to_string(cloud_.size()) + " POINTS");
  }

 private:
  void read_row(std::byte* to) {
    skip_empty_lines();
    if (at_ == end_) fail("truncated: row ", " is missing, of " + std::to_string(cloud_.size()));
    std::size_t read = 0;
    for (const PointField& field : cloud_.fields) {
      for (std::uint32_t i = 0; i < field.count; ++i, ++read, to += field.size) {
        skip_blanks();
        if (at_ == end_ || *at_ == '\n') {
          fail("truncated: row ", " has " + std::to_string(read) + " values instead of " +
                                      std::to_string(values_per_point(cloud_)));
        }
        read_value(field, to);
      }
    }
    skip_blanks();
    if (at_ != end_ && *at_ != '\n') {
      fail("row ", " has more than " + std::to_string(values_per_point(cloud_)) + " values");
    }
  }

  void read_value(const PointField& field, std::byte* to) {
    const char* after = with_element_type(field, [&](auto value) {
      const char* stop = parse_number(at_, end_, value);
      std::memcpy(to, &value, sizeof value);
      return stop;
    });
    if (!after || (after != end_ && *after != '\n' && !is_blank(*after))) {
      const char* stop = at_;
      while (stop != end_ && *stop != '\n' && !is_blank(*stop))
        ++stop;
      fail("row ", ", field " + in_quotes(field.name) + ": " +
                       in_quotes({at_, static_cast<std::size_t>(stop - at_)}) + " is not a number of TYPE " +
                       field.type + ", SIZE " + std::to_string(field.size));
    }
    at_ = after;
  }

  void skip_blanks() {
    while (at_ != end_ && is_blank(*at_))
      ++at_;
  }

  void skip_empty_lines() {
    while (at_ != end_ && (is_blank(*at_) || *at_ == '\n'))
      ++at_;
  }

  [[noreturn]] void fail(const char* before, const std::string& after) const {
    throw IoError(before + std::to_string(row_) + after);
  }

  const char* at_;
  const char* end_;
  RawCloud& cloud_;
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
