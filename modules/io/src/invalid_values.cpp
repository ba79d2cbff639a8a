// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "invalid_values.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include "fields.h"
#include "text.h"

namespace pcl_bv::detail {
namespace {

// Returns the name of the field's type with its article.
std::string kind_of(const PointField& field) {
  if (field.type == 'F') return "a number";
  const std::string bytes = field.size == 1 ? "1 byte" : std::to_string(field.size) + " bytes";
  return (field.type == 'U' ? "an unsigned integer of " : "an integer of ") + bytes;
}

// Reads a negative integer into an unsigned field with the wrap-around of a C++ conversion, because many
// programs write -1 for "none" into unsigned fields.
bool read_negative(std::string_view word, const PointField& field, std::byte* to) {
  double number = 0;
  if (field.type != 'U' || !read_number(word, number)) return false;
  if (!(number < 0 && number >= -2147483648.0) || number != std::trunc(number)) return false;
  const auto whole = static_cast<std::int64_t>(number);
  return with_element_type(field, [&](auto value) {
    if constexpr (std::is_integral_v<decltype(value)>) {
      if (!std::in_range<std::make_signed_t<decltype(value)>>(whole)) return false;
      value = static_cast<decltype(value)>(whole);
      std::memcpy(to, &value, sizeof value);
    }
    return true;
  });
}

}  // namespace

InvalidValues::InvalidValues(const RawCloud& cloud, std::string_view row, std::size_t first_number)
    : cloud_(cloud), row_(row), first_number_(first_number), fields_(cloud.fields.size()) {}

bool InvalidValues::replace_value(TextRows& rows, std::size_t field, std::byte* to) {
  const PointField& of = cloud_.fields[field];
  if (is_coordinate_name(of.name) || !rows.find_value()) return false;
  if (read_negative(rows.value(), of, to)) {
    rows.skip_value();
    return true;
  }
  const std::size_t row = static_cast<std::size_t>(to - cloud_.data.data()) / cloud_.point_step;
  FieldRecord& known = fields_[field];
  known.count.fetch_add(1, std::memory_order_relaxed);
  if (row < known.first_row.load(std::memory_order_relaxed)) {
    const std::lock_guard lock(mutex_);
    if (row < known.first_row) {
      known.first_row = row;
      known.first = rows.quoted_value();
    }
  }
  with_element_type(of, [to](auto value) {
    value = 0;
    if constexpr (std::is_floating_point_v<decltype(value)>)
      value = std::numeric_limits<decltype(value)>::quiet_NaN();
    std::memcpy(to, &value, sizeof value);
  });
  rows.skip_value();
  return true;
}

void InvalidValues::report(RawCloud& cloud) const {
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    const FieldRecord& known = fields_[i];
    if (known.count == 0) continue;
    const PointField& field = cloud.fields[i];
    cloud.invalid_fields.push_back(field.name);
    add_note(cloud, row_ + " " + std::to_string(first_number_ + known.first_row) + ", field " +
                        in_quotes(field.name) + ": " + known.first + " is not " + kind_of(field) + "; " +
                        std::to_string(known.count) +
                        (known.count == 1 ? " such value is" : " such values are") + " replaced by " +
                        (field.type == 'F' ? "NaN" : "0"));
  }
}

}  // namespace pcl_bv::detail
