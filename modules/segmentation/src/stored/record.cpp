// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "record.h"

namespace pcl_bv::detail {

void write_coordinates(const Coordinates& point, ScalarType scalar, std::byte* to) {
  if (scalar == ScalarType::float32) {
    const float xyz[3] = {static_cast<float>(point.x), static_cast<float>(point.y),
                          static_cast<float>(point.z)};
    std::memcpy(to, xyz, sizeof xyz);
  } else {
    const double xyz[3] = {point.x, point.y, point.z};
    std::memcpy(to, xyz, sizeof xyz);
  }
}

PointView view_of_records(const std::vector<std::byte>& records, std::size_t step, ScalarType scalar) {
  PointView view;
  view.data = records.data();
  view.stride = view.readable = step;
  view.count = records.size() / step;
  view.scalar = scalar;
  return view;
}

}  // namespace pcl_bv::detail
