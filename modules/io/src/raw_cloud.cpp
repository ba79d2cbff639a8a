// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/io/raw_cloud.h"

#include <algorithm>
#include <stdexcept>

#include "copy_strided.h"
#include "fields.h"
#include "pcl_bv/io/io_error.h"

namespace pcl_bv {
namespace {

bool is_coordinate(const PointField& field) {
  return field.type == 'F' && (field.size == 4 || field.size == 8) && field.count == 1;
}

const PointField* find_field(const std::vector<PointField>& fields, std::string_view name) {
  const auto found =
      std::find_if(fields.begin(), fields.end(), [&](const PointField& field) { return field.name == name; });
  return found == fields.end() ? nullptr : &*found;
}

}  // namespace

const PointField* find_field(const RawCloud& cloud, std::string_view name) {
  return find_field(cloud.fields, name);
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

PointView view_of_fields(const std::byte* data, std::size_t count, std::size_t point_step,
                         const std::vector<PointField>& fields) {
  check_coordinates<std::invalid_argument>(fields);
  const CoordinateFields xyz = coordinate_fields(fields);
  if (!xyz.adjacent) throw std::invalid_argument("fields x, y and z do not lie side by side in this order");
  if (point_step < 3 * size_of(xyz.scalar) || xyz.offset[0] > point_step - 3 * size_of(xyz.scalar))
    throw std::invalid_argument("fields x, y and z reach beyond the point_step of " +
                                std::to_string(point_step) + " bytes");
  if (count > 0 && data == nullptr) throw std::invalid_argument("points without data");
  return count > 0 ? view_at(xyz, data, count, point_step) : PointView();
}

PointView RawCloud::xyz() const {
  const CoordinateFields in = coordinate_fields(fields);
  if (size() == 0 || !in.readable) return {};
  if (in.adjacent) return view_at(in, data.data(), size(), point_step);
  return packed_points(packed_xyz.data(), in.scalar, packed_xyz.size() / (3 * size_of(in.scalar)));
}

}  // namespace pcl_bv
