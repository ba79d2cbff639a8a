// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A cloud as a file holds it: every field kept, in records, with a view of its coordinates.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pcl_bv/io/byte_buffer.h"
#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// One field of a point record, with the letters and sizes of the .pcd format.
struct PointField {
  std::string name;         ///< Without white space; "_" marks padding and may occur more than once.
  char type = 'F';          ///< 'F' floating point, 'I' signed, 'U' unsigned.
  std::uint32_t size = 4;   ///< Bytes of one element: 1, 2, 4 or 8.
  std::uint32_t count = 1;  ///< Elements per point.
  std::size_t offset = 0;   ///< Bytes from the start of the record.

  /// Bytes of all its elements.
  std::size_t bytes() const { return std::size_t{size} * count; }
};

/// Points in records of `point_step` bytes, row by row; organised clouds have height > 1. The fields lie one
/// after the other without gaps and fill the record.
struct RawCloud {
  std::vector<PointField> fields;
  std::size_t width = 0;
  std::size_t height = 1;
  std::array<double, 7> viewpoint{0, 0, 0, 1, 0, 0, 0};  ///< tx ty tz qw qx qy qz; kept, never applied.
  std::size_t point_step = 0;
  ByteBuffer data;  ///< width * height * point_step bytes, little-endian.
  /// x y z of all points, all float32 or all float64. Filled only if the record does not hold them side by
  /// side as one floating-point type.
  ByteBuffer packed_xyz;

  /// What a reader noticed about the file and did not refuse, one line for the user; usually empty.
  std::string note;

  /// Fields with values that are no numbers of their type, which are 0 or NaN here; `note` says which.
  std::vector<std::string> unread_fields;

  std::size_t size() const { return width * height; }

  /// The coordinates of all points, in their order: the fields x, y and z, or X, Y and Z where there is none
  /// of that name. Integers and mixed types are viewed as float32 if that holds all values of their types,
  /// else as float64. Views `data` (or `packed_xyz`), so it dies with the cloud. Empty for an empty cloud,
  /// and for one without such fields, of one element each.
  PointView xyz() const;
};

/// The names of the fields that hold x, y and z, of any fields that have a `name`: "x", or "X" where no field
/// is called x but one is called X; so for y and z. They need not exist.
template <typename Fields>
std::array<std::string_view, 3> coordinate_names(const Fields& fields) {
  std::array<std::string_view, 3> names{"x", "y", "z"};
  constexpr std::array<std::string_view, 3> upper{"X", "Y", "Z"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    bool exists = false, exists_upper = false;
    for (const auto& field : fields) {
      exists = exists || field.name == names[axis];
      exists_upper = exists_upper || field.name == upper[axis];
    }
    if (!exists && exists_upper) names[axis] = upper[axis];
  }
  return names;
}

/// The coordinates of `count` records, `point_step` bytes apart, which a message describes by fields like
/// those of sensor_msgs/PointCloud2 (FLOAT32 is 'F', 4, FLOAT64 'F', 8); nothing is copied, and the view dies
/// with the data. x, y and z may stand anywhere in the record and need no alignment, but side by side in this
/// order, all float32 or all float64, in this machine's byte order; X, Y and Z serve where there is no x, y
/// or z, and other fields do not matter. Throws
/// std::invalid_argument for anything else, also where they reach beyond the record.
PointView view_of_fields(const std::byte* data, std::size_t count, std::size_t point_step,
                         const std::vector<PointField>& fields);

/// One number of each record, where it lies.
struct FieldView {
  const std::byte* data = nullptr;  ///< Of the first record.
  std::size_t stride = 0;           ///< Bytes from one record to the next.
  char type = 'F';                  ///< As PointField has them.
  std::uint32_t size = 4;

  float at(std::size_t record) const;  ///< Rounded to nearest, where float32 does not hold it.
};

/// How much light came back to each point, in a unit of the sensor's own: the first field of one element that
/// is called intensity (Intensity, INTENSITY), intensities, reflectivity or i. nullopt if there is none. The
/// view dies with the records.
std::optional<FieldView> intensity_of(const std::vector<PointField>& fields, const std::byte* records,
                                      std::size_t point_step);

/// The first field of this name, or null.
const PointField* find_field(const RawCloud& cloud, std::string_view name);

}  // namespace pcl_bv
