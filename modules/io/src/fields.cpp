// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "fields.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

namespace pcl_bv {
using namespace detail;
namespace {

// A size that is known at compile time turns each copy into one load and one store. Nearly all fields have 4
// bytes.
template <std::size_t bytes>
constexpr std::integral_constant<std::size_t, bytes> fixed;

template <typename Size>
void copy(StridedSource from, StridedTarget to, Size bytes, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    std::memcpy(to.base + to.offset + i * to.stride, from.base + from.offset + i * from.stride, bytes);
  }
}

bool is_coordinate(const PointField& field) {
  return field.count == 1 && (field.type != 'F' || field.size >= 4);
}

// Returns whether float32 represents every value of the field's type exactly.
bool fits_float32(const PointField& field) {
  return field.type == 'F' ? field.size == 4 : field.size <= 2;
}

std::array<const PointField*, 3> find_coordinates(const std::vector<PointField>& fields) {
  const std::array<std::string_view, 3> names = coordinate_names(fields);
  return {find_field(fields, names[0]), find_field(fields, names[1]), find_field(fields, names[2])};
}

// Converts to double. Throws IoError for integers above 2^53 in magnitude, which may not be exact doubles.
template <typename T>
double exact_double(T value) {
  if constexpr (std::is_integral_v<T> && sizeof(T) == 8) {
    constexpr T limit = T{1} << 53;
    bool beyond = value > limit;
    if constexpr (std::is_signed_v<T>) beyond = beyond || value < -limit;
    if (beyond)
      throw IoError("the coordinate " + std::to_string(value) +
                    " is too large: integers may be at most 2^53 in magnitude");
  }
  return static_cast<double>(value);
}

template <typename From, typename To>
void convert(StridedSource from, StridedTarget to, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    From value;
    std::memcpy(&value, from.base + from.offset + i * from.stride, sizeof value);
    const To converted = static_cast<To>(exact_double(value));
    std::memcpy(to.base + to.offset + i * to.stride, &converted, sizeof converted);
  }
}

}  // namespace

void detail::copy_strided(StridedSource from, StridedTarget to, std::size_t bytes, std::size_t count) {
  switch (bytes) {
    case 1:
      return copy(from, to, fixed<1>, count);
    case 2:
      return copy(from, to, fixed<2>, count);
    case 4:
      return copy(from, to, fixed<4>, count);
    case 8:
      return copy(from, to, fixed<8>, count);
    default:
      return copy(from, to, bytes, count);
  }
}

const PointField* detail::find_field(const std::vector<PointField>& fields, std::string_view name) {
  const auto found =
      std::find_if(fields.begin(), fields.end(), [&](const PointField& field) { return field.name == name; });
  return found == fields.end() ? nullptr : &*found;
}

void detail::append_field(PointField field, RawCloud& cloud) {
  field.offset = cloud.point_step;
  cloud.point_step += field.bytes();
  cloud.fields.push_back(std::move(field));
}

std::string detail::default_column_name(std::size_t column, std::size_t columns) {
  constexpr std::array names{"x", "y", "z", "intensity"};
  const bool named = column < 3 || (column == 3 && columns == 4);
  return named ? names[column] : "field" + std::to_string(column + 1);
}

bool detail::is_coordinate_name(std::string_view name) {
  return name.size() == 1 && std::string_view("xyzXYZ").find(name) != std::string_view::npos;
}

CoordinateFields detail::coordinate_fields(const std::vector<PointField>& fields) {
  CoordinateFields result;
  const std::array<const PointField*, 3> found = find_coordinates(fields);
  bool of_scalar = true;
  for (const PointField* field : found) {
    if (field == nullptr || !is_coordinate(*field)) return {};
    if (!fits_float32(*field)) result.scalar = ScalarType::float64;
  }
  const std::size_t bytes = size_of(result.scalar);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result.offset[axis] = found[axis]->offset;
    result.type[axis] = found[axis]->type;
    result.size[axis] = found[axis]->size;
    of_scalar = of_scalar && found[axis]->type == 'F' && found[axis]->size == bytes;
  }
  result.readable = true;
  result.adjacent = of_scalar && result.offset[1] == result.offset[0] + bytes &&
                    result.offset[2] == result.offset[0] + 2 * bytes;
  return result;
}

PointView detail::view_at(const CoordinateFields& fields, const std::byte* records, std::size_t count,
                          std::size_t point_step) {
  PointView view;
  view.scalar = fields.scalar;
  view.data = records + fields.offset[0];
  view.stride = point_step;
  view.readable = point_step - fields.offset[0];
  view.count = count;
  return view;
}

void detail::require_coordinates(RawCloud& cloud) {
  if (cloud.size() > 0 || coordinate_fields(cloud.fields).readable) return check_coordinates(cloud.fields);
  cloud.fields = {{"x", 'F', 4, 1, 0}, {"y", 'F', 4, 1, 4}, {"z", 'F', 4, 1, 8}};
  cloud.point_step = 12;
}

void detail::add_note(RawCloud& cloud, const std::string& note) {
  cloud.note += (cloud.note.empty() ? "" : "; ") + note;
}

bool detail::is_not_identity(const std::array<double, 7>& viewpoint) {
  for (const std::size_t i : {0, 1, 2, 4, 5, 6}) {
    if (viewpoint[i] != 0) return true;
  }
  return false;
}

void detail::pack_coordinates(const CoordinateFields& fields, const std::byte* records, std::size_t count,
                              std::size_t point_step, std::byte* xyz) {
  const std::size_t bytes = size_of(fields.scalar);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const StridedSource from{records, fields.offset[axis], point_step};
    const StridedTarget to{xyz, axis * bytes, 3 * bytes};
    if (fields.type[axis] == 'F' && fields.size[axis] == bytes) {
      copy_strided(from, to, bytes, count);
      continue;
    }
    with_element_type({{}, fields.type[axis], fields.size[axis]}, [&](auto example) {
      fields.scalar == ScalarType::float32 ? convert<decltype(example), float>(from, to, count)
                                           : convert<decltype(example), double>(from, to, count);
    });
  }
}

template <typename Error>
void detail::check_coordinates(const std::vector<PointField>& fields) {
  std::string missing;
  const std::array<std::string_view, 3> names = coordinate_names(fields);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto named = [&](const PointField& field) { return field.name == names[axis]; };
    const auto count = std::count_if(fields.begin(), fields.end(), named);
    if (count > 1) throw Error("field " + std::string(names[axis]) + " occurs twice");
    if (count == 0) missing += (missing.empty() ? "" : ", ") + std::string(names[axis]);
  }
  if (!missing.empty()) throw Error("no field " + missing);
  for (const PointField* field : find_coordinates(fields)) {
    if (is_coordinate(*field)) continue;
    throw Error("field " + field->name + " of TYPE " + field->type + ", SIZE " + std::to_string(field->size) +
                ", COUNT " + std::to_string(field->count) +
                " is not supported, only integers and floats of 4 or 8 bytes, COUNT 1");
  }
}

template void detail::check_coordinates<IoError>(const std::vector<PointField>&);
template void detail::check_coordinates<std::invalid_argument>(const std::vector<PointField>&);

}  // namespace pcl_bv
