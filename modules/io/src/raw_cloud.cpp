// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/io/raw_cloud.h"

#include <stdexcept>

#include "fields.h"

namespace pcl_bv {

const PointField* find_field(const RawCloud& cloud, std::string_view name) {
  return find_field(cloud.fields, name);
}

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
