// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/io/raw_cloud.h"

#include <algorithm>

#include "coordinate_fields.h"
#include "pcl_bv/io/io_error.h"

namespace pcl_bv {
namespace {

bool is_coordinate(const PointField& field) {
  return field.type == 'F' && (field.size == 4 || field.size == 8) && field.count == 1;
}

}  // namespace

const PointField* find_field(const RawCloud& cloud, std::string_view name) {
  const auto found = std::find_if(cloud.fields.begin(), cloud.fields.end(),
                                  [&](const PointField& field) { return field.name == name; });
  return found == cloud.fields.end() ? nullptr : &*found;
}

CoordinateFields coordinate_fields(const RawCloud& cloud) {
  CoordinateFields result;
  const std::string_view names[3] = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis) {
    const PointField* field = find_field(cloud, names[axis]);
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

void check_coordinates(const RawCloud& cloud) {
  std::string missing;
  for (const char* name : {"x", "y", "z"}) {
    const auto named = [&](const PointField& field) { return field.name == name; };
    const auto count = std::count_if(cloud.fields.begin(), cloud.fields.end(), named);
    if (count > 1) throw IoError(std::string("field ") + name + " occurs twice");
    if (count == 0) missing += (missing.empty() ? "" : ", ") + std::string(name);
  }
  if (!missing.empty()) throw IoError("no field " + missing);
  for (const char* name : {"x", "y", "z"}) {
    const PointField& field = *find_field(cloud, name);
    if (is_coordinate(field)) continue;
    throw IoError(std::string("field ") + name + " of TYPE " + field.type + ", SIZE " +
                  std::to_string(field.size) + ", COUNT " + std::to_string(field.count) +
                  " is not supported, only F, 4, 1 and F, 8, 1");
  }
  if (!coordinate_fields(cloud).readable) throw IoError("fields x, y and z differ in SIZE");
}

PointView RawCloud::xyz() const {
  const CoordinateFields fields_xyz = coordinate_fields(*this);
  if (size() == 0 || !fields_xyz.readable) return {};
  PointView view;
  view.scalar = fields_xyz.scalar;
  const std::size_t packed_step = 3 * size_of(view.scalar);
  view.data = fields_xyz.adjacent ? data.data() + fields_xyz.offset[0] : packed_xyz.data();
  view.stride = fields_xyz.adjacent ? point_step : packed_step;
  view.readable = fields_xyz.adjacent ? point_step - fields_xyz.offset[0] : packed_step;
  view.count = fields_xyz.adjacent ? size() : packed_xyz.size() / packed_step;
  return view;
}

}  // namespace pcl_bv
