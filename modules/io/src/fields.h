// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Fields of records: what they mean, and copies between records and arrays.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "pcl_bv/io/io_error.h"
#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv {

/// Calls function with a value of the C++ type that the field's letter and size mean. Floating point of 1 and
/// 2 bytes has no type: that is for the caller to refuse.
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

/// Where the elements of a strided copy lie: the first one `offset` bytes after `base`, each `stride` bytes
/// after the one before it. `base` may be null if there are none.
template <typename Byte>
struct Strided {
  Byte* base;
  std::size_t offset;
  std::size_t stride;
};
using StridedSource = Strided<const std::byte>;
using StridedTarget = Strided<std::byte>;

/// Copies `count` elements of `bytes` bytes each. The two must not overlap.
void copy_strided(StridedSource from, StridedTarget to, std::size_t bytes, std::size_t count);

/// The first field of this name, or null.
const PointField* find_field(const std::vector<PointField>& fields, std::string_view name);

/// Whether it is x, y or z (or X, Y, Z) of these fields.
bool is_coordinate_name(std::string_view name);

/// Where x, y and z are in the record.
struct CoordinateFields {
  std::array<std::size_t, 3> offset{};
  std::array<char, 3> type{};
  std::array<std::uint32_t, 3> size{};
  /// What they are read as: float32 if that holds every value of their types, else float64.
  ScalarType scalar = ScalarType::float32;
  bool readable = false;  ///< All three exist, as one number each.
  bool adjacent = false;  ///< They lie side by side in that order, as `scalar`, so that a PointView fits.
};

CoordinateFields coordinate_fields(const std::vector<PointField>& fields);

/// The coordinates of these records, where they lie; for fields that are adjacent.
PointView view_at(const CoordinateFields& fields, const std::byte* records, std::size_t count,
                  std::size_t point_step);

/// check_coordinates(), but a cloud without points gets x, y and z as float32 where it lacks them: filters
/// that have nothing left write no fields.
void require_coordinates(RawCloud& cloud);

/// Adds a line to what is said of the cloud.
void add_note(RawCloud& cloud, const std::string& note);

/// Whether a viewpoint is a translation or a rotation. All zeros is treated as the identity.
bool moves_points(const std::array<double, 7>& viewpoint);

/// Copies the coordinates of these records to where packed_points() finds them; integers become floating
/// point. Throws IoError for an integer above 2^53, which a double cannot hold exactly.
void pack_coordinates(const CoordinateFields& fields, const std::byte* records, std::size_t count,
                      std::size_t point_step, std::byte* xyz);

/// Throws `Error` unless x, y and z (or X, Y, Z) exist, each once, in a form that is readable: IoError for
/// readers, or std::invalid_argument.
template <typename Error = IoError>
void check_coordinates(const std::vector<PointField>& fields);

}  // namespace pcl_bv
