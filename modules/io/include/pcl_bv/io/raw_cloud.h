// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A cloud with all fields of its file, stored as records, and a view of its coordinates.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Error thrown if a file cannot be read or written. what() is the reason in one line, without the file's
/// name. The caller adds the name as the user gave it.
class IoError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Returns the text in quotes, for an error message. Texts of more than 40 characters are cut and end in
/// "...'". Each byte that is not printable ASCII becomes `?`.
std::string in_quotes(std::string_view text);

namespace detail {
void* allocate_buffer(std::size_t bytes);
void free_buffer(void* memory, std::size_t bytes) noexcept;
}  // namespace detail

/// Allocator for standard containers. New elements without a value, such as those that std::vector::resize()
/// appends, stay uninitialised. Blocks of 4 MiB or more are aligned to 2 MiB, and the operating system is
/// advised to use huge pages of 2 MiB for them.
template <typename T>
class BufferAllocator {
 public:
  using value_type = T;

  BufferAllocator() = default;
  template <typename U>
  BufferAllocator(const BufferAllocator<U>&) noexcept {}

  /// Returns uninitialised memory for `n` elements. Throws std::bad_alloc.
  T* allocate(std::size_t n) {
    if (n > static_cast<std::size_t>(-1) / sizeof(T)) throw std::bad_alloc();
    return static_cast<T*>(detail::allocate_buffer(n * sizeof(T)));
  }
  /// Frees memory that allocate(n) returned.
  void deallocate(T* memory, std::size_t n) noexcept { detail::free_buffer(memory, n * sizeof(T)); }

  /// Leaves the element uninitialised if it is of a trivial type.
  template <typename U>
  void construct(U* at) noexcept {
    ::new (static_cast<void*>(at)) U;
  }
  /// Constructs an element from these values.
  template <typename U, typename... Values>
  void construct(U* at, Values&&... values) {
    ::new (static_cast<void*>(at)) U(std::forward<Values>(values)...);
  }

  friend bool operator==(const BufferAllocator&, const BufferAllocator&) { return true; }
  friend bool operator!=(const BufferAllocator&, const BufferAllocator&) { return false; }
};

/// Vector of bytes. resize() leaves the new bytes uninitialised. Write them before reading them.
using ByteBuffer = std::vector<std::byte, BufferAllocator<std::byte>>;

/// One field of a point record. Its type and size are as in the .pcd format.
struct PointField {
  std::string name;         ///< Name without white space. "_" marks padding and may occur more than once.
  char type = 'F';          ///< 'F' floating point, 'I' signed integer, 'U' unsigned integer.
  std::uint32_t size = 4;   ///< Bytes of one element: 1, 2, 4 or 8.
  std::uint32_t count = 1;  ///< Elements per point.
  std::size_t offset = 0;   ///< Bytes from the start of the record.

  /// Returns the number of bytes of all elements of one point.
  std::size_t bytes() const { return std::size_t{size} * count; }
};

/// Points as records of `point_step` bytes, row by row. Organised clouds have height > 1. The fields follow
/// each other without gaps and fill the record.
struct RawCloud {
  std::vector<PointField> fields;  ///< Fields of a record, in the order of their offsets.
  std::size_t width = 0;           ///< Points per row.
  std::size_t height = 1;          ///< Number of rows.
  std::array<double, 7> viewpoint{0, 0, 0, 1, 0, 0, 0};  ///< tx ty tz qw qx qy qz; stored, never applied.
  std::size_t point_step = 0;                            ///< Bytes per record.
  ByteBuffer data;  ///< width * height * point_step bytes, little-endian.
  /// Coordinates x y z of all points, all float32 or all float64. Empty if the records have x, y and z
  /// adjacent, in this order, as one floating-point type.
  ByteBuffer packed_xyz;

  /// Warnings of the reader about the file, as one line for the user. Usually empty.
  std::string note;

  /// Names of the fields with values that were not numbers of the field's type and were replaced by 0 or NaN.
  /// `note` has the details.
  std::vector<std::string> invalid_fields;

  /// Returns the number of points.
  std::size_t size() const { return width * height; }

  /// Returns a view of the coordinates of all points, in the order of the points. The coordinates are the
  /// fields x, y and z, or X, Y and Z where the lower-case name is missing (see coordinate_names()). If the
  /// types of the three fields differ or are integers, the view is float32 if float32 represents all values
  /// of these types exactly, else float64. The view refers to `data` or `packed_xyz` and is valid as long as
  /// the cloud. Returns an empty view if the cloud is empty, or if one of the three fields is missing or has
  /// more than one element.
  PointView xyz() const;
};

/// Returns the names of the fields with the coordinates x, y and z. The first name is "X" if there is a field
/// X but no field x, else "x". The same holds for y and z. The fields need not exist. `Fields` is any range
/// of elements with a member `name`.
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

/// Returns a view of the coordinates of `count` records, which are `point_step` bytes apart, for example the
/// records of a sensor_msgs/PointCloud2 message. (Its FLOAT32 fields have type 'F' and size 4, its FLOAT64
/// fields type 'F' and size 8.) Nothing is copied. The view is valid as long as the data. The fields x, y and
/// z (or X, Y and Z, see coordinate_names()) must be adjacent in this order, all float32 or all float64, in
/// this machine's byte order. They may be anywhere in the record and need no alignment. Other fields are
/// ignored. If `count` is 0, the view is empty. Throws std::invalid_argument for any other layout, for
/// coordinates beyond the end of the record, and if `data` is null but `count` is not 0.
PointView view_of_fields(const std::byte* data, std::size_t count, std::size_t point_step,
                         const std::vector<PointField>& fields);

/// View of one number per record.
struct FieldView {
  const std::byte* data = nullptr;  ///< Address of the first record's number.
  std::size_t stride = 0;           ///< Bytes from one record to the next.
  char type = 'F';                  ///< As PointField::type.
  std::uint32_t size = 4;           ///< As PointField::size.

  float at(std::size_t record) const;       ///< Returns the record's number, rounded to the nearest float32.
  double number(std::size_t record) const;  ///< Returns the record's number, rounded to the nearest float64.
};

/// Returns a view of the intensity of each point, in the sensor's own unit. Field names of the intensity are,
/// in order of preference, intensity, Intensity, INTENSITY, intensities, reflectivity and i. The field must
/// have one element of a supported type. Returns nullopt if there is no such field. The view is valid as long
/// as the records.
std::optional<FieldView> intensity_of(const std::vector<PointField>& fields, const std::byte* records,
                                      std::size_t point_step);

/// Returns a view of the time of each point, in the driver's own unit. Field names of the time are, in order
/// of preference, t, time, timestamp, time_stamp, offset_time and time_ns. Otherwise like intensity_of().
std::optional<FieldView> times_of(const std::vector<PointField>& fields, const std::byte* records,
                                  std::size_t point_step);

/// Returns the first field of this name, or null.
const PointField* find_field(const RawCloud& cloud, std::string_view name);

}  // namespace pcl_bv
