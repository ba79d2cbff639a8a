// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Interprets the fields of records, and copies values between records and arrays.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv::detail {

/// Calls `function` with a value of the C++ type that matches the field's type letter and size. The caller
/// must refuse floating point of 1 or 2 bytes, which has no C++ type.
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

/// Source or target of a strided copy. The first element is `offset` bytes after `base`. Each following
/// element is `stride` bytes after the previous element. `base` may be null if there are no elements.
template <typename Byte>
struct Strided {
  Byte* base;
  std::size_t offset;
  std::size_t stride;
};
using StridedSource = Strided<const std::byte>;
using StridedTarget = Strided<std::byte>;

/// Copies `count` elements of `bytes` bytes each. Source and target must not overlap.
void copy_strided(StridedSource from, StridedTarget to, std::size_t bytes, std::size_t count);

/// Returns the first field of this name, or null.
const PointField* find_field(const std::vector<PointField>& fields, std::string_view name);

/// Files with more columns are refused.
inline constexpr std::size_t kMaxColumns = 4096;

/// Appends a field behind the last field of the record.
void append_field(PointField field, RawCloud& cloud);

/// Returns the name of a column of a file without names: x, y, z, intensity if there are four, field4 and so
/// on.
std::string default_column_name(std::size_t column, std::size_t columns);

/// Returns whether the name is x, y, z, X, Y or Z.
bool is_coordinate_name(std::string_view name);

/// Offsets and types of x, y and z in the record.
struct CoordinateFields {
  std::array<std::size_t, 3> offset{};
  std::array<char, 3> type{};
  std::array<std::uint32_t, 3> size{};
  /// Type of the coordinates in views. It is float32 if float32 represents all values of the three types,
  /// else float64.
  ScalarType scalar = ScalarType::float32;
  bool readable = false;  ///< All three fields exist, with one element each, of a supported type.
  bool adjacent = false;  ///< The fields are adjacent in this order, of type `scalar`. No copy is needed.
};

/// Finds the coordinates in the record. CoordinateFields::readable is false if a coordinate is missing or not
/// supported.
CoordinateFields coordinate_fields(const std::vector<PointField>& fields);

/// Returns a view of the coordinates in these records, without a copy. Requires `fields.adjacent`.
PointView view_at(const CoordinateFields& fields, const std::byte* records, std::size_t count,
                  std::size_t point_step);

/// Calls check_coordinates(), except for a cloud without points and without readable coordinates. The fields
/// of such a cloud become x, y and z as float32, because filters that remove all points often write no
/// fields.
void require_coordinates(RawCloud& cloud);

/// Appends a warning to the cloud's note.
void add_note(RawCloud& cloud, const std::string& note);

/// Returns whether the viewpoint (tx ty tz qw qx qy qz) has a translation or rotation. All zeros are treated
/// as the identity.
bool is_not_identity(const std::array<double, 7>& viewpoint);

/// Copies the coordinates of these records to `xyz` in the layout of packed_points(), converted to
/// `fields.scalar`. Throws IoError for an integer above 2^53 in magnitude, because a double may not represent
/// it exactly.
void pack_coordinates(const CoordinateFields& fields, const std::byte* records, std::size_t count,
                      std::size_t point_step, std::byte* xyz);

/// Throws `Error` (IoError or std::invalid_argument) unless x, y and z (or X, Y, Z) each exist exactly once,
/// with one element of a supported type.
template <typename Error = IoError>
void check_coordinates(const std::vector<PointField>& fields);

}  // namespace pcl_bv::detail
