// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Where the coordinates of a record are.
#include "pcl_bv/io/raw_cloud.h"

#include <algorithm>

#include "coordinate_fields.h"

namespace pcl_bv {

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
    if (!field || field->type != 'F' || field->size != 4 || field->count != 1) return {};
    result.offset[axis] = field->offset;
  }
  result.readable = true;
  result.adjacent = result.offset[1] == result.offset[0] + 4 && result.offset[2] == result.offset[0] + 8;
  return result;
}

PointView RawCloud::xyz() const {
  const CoordinateFields fields_xyz = coordinate_fields(*this);
  if (size() == 0 || !fields_xyz.readable) return {};
  if (!fields_xyz.adjacent) return PointView::of(packed_xyz.data(), 3 * sizeof(float), packed_xyz.size() / 3);
  PointView view;
  view.data = data.data() + fields_xyz.offset[0];
  view.stride = point_step;
  view.readable = point_step - fields_xyz.offset[0];
  view.count = size();
  return view;
}

}  // namespace pcl_bv
