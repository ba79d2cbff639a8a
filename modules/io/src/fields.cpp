// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "fields.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace pcl_bv {
namespace {

// A size known at compile time turns each copy into one load and store; fields of 4 bytes are nearly all
// there are.
template <std::size_t bytes>
constexpr std::integral_constant<std::size_t, bytes> fixed;

template <typename Size>
void copy(StridedSource from, StridedTarget to, Size bytes, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    std::memcpy(to.base + to.offset + i * to.stride, from.base + from.offset + i * from.stride, bytes);
  }
}

bool is_coordinate(const PointField& field) {
  return field.type == 'F' && (field.size == 4 || field.size == 8) && field.count == 1;
}

}  // namespace

void copy_strided(StridedSource from, StridedTarget to, std::size_t bytes, std::size_t count) {
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

const PointField* find_field(const std::vector<PointField>& fields, std::string_view name) {
  const auto found =
      std::find_if(fields.begin(), fields.end(), [&](const PointField& field) { return field.name == name; });
  return found == fields.end() ? nullptr : &*found;
}

CoordinateFields coordinate_fields(const std::vector<PointField>& fields) {
  CoordinateFields result;
  const std::string_view names[3] = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis) {
    const PointField* field = find_field(fields, names[axis]);
    if (!field || !is_coordinate(*field)) return {};
    const ScalarType scalar = field->size == 8 ? ScalarType::float64 : ScalarType::float32;
    if (axis > 0 && scalar != result.scalar) return {};
    result.scalar = scalar;
    result.offset[axis] = field->offset;
  }
  const std::size_t bytes = size_of(result.scalar);
  result.readable = true;
  result.adjacent =
      result.offset[1] == result.offset[0] + bytes && result.offset[2] == result.offset[0] + 2 * bytes;
  return result;
}

PointView view_at(const CoordinateFields& fields, const std::byte* records, std::size_t count,
                  std::size_t point_step) {
  PointView view;
  view.scalar = fields.scalar;
  view.data = records + fields.offset[0];
  view.stride = point_step;
  view.readable = point_step - fields.offset[0];
  view.count = count;
  return view;
}

void pack_coordinates(const CoordinateFields& fields, const std::byte* records, std::size_t count,
                      std::size_t point_step, std::byte* xyz) {
  const std::size_t bytes = size_of(fields.scalar);
  for (std::size_t axis = 0; axis < 3; ++axis)
    copy_strided({records, fields.offset[axis], point_step}, {xyz, axis * bytes, 3 * bytes}, bytes, count);
}

template <typename Error>
void check_coordinates(const std::vector<PointField>& fields) {
  std::string missing;
  for (const char* name : {"x", "y", "z"}) {
    const auto named = [&](const PointField& field) { return field.name == name; };
    const auto count = std::count_if(fields.begin(), fields.end(), named);
    if (count > 1) throw Error(std::string("field ") + name + " occurs twice");
    if (count == 0) missing += (missing.empty() ? "" : ", ") + std::string(name);
  }
  if (!missing.empty()) throw Error("no field " + missing);
  for (const char* name : {"x", "y", "z"}) {
    const PointField& field = *find_field(fields, name);
    if (is_coordinate(field)) continue;
    throw Error(std::string("field ") + name + " of TYPE " + field.type + ", SIZE " +
                std::to_string(field.size) + ", COUNT " + std::to_string(field.count) +
                " is not supported, only F, 4, 1 and F, 8, 1");
  }
  if (!coordinate_fields(fields).readable) throw Error("fields x, y and z differ in SIZE");
}

template void check_coordinates<IoError>(const std::vector<PointField>&);
template void check_coordinates<std::invalid_argument>(const std::vector<PointField>&);

}  // namespace pcl_bv
