// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Views of arrays of point structs, such as PCL's. Does not depend on any particular point type.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Whether a struct has members x, y, z, all float or all double.
template <typename Record, typename = void>
struct has_xyz : std::false_type {};
template <typename Record>
struct has_xyz<Record, std::void_t<decltype(Record::x), decltype(Record::y), decltype(Record::z)>> {
  using Scalar = std::remove_cv_t<decltype(Record::x)>;
  static constexpr bool one_type = std::is_same_v<Scalar, std::remove_cv_t<decltype(Record::y)>> &&
                                   std::is_same_v<Scalar, std::remove_cv_t<decltype(Record::z)>>;
  static constexpr bool value = one_type && (std::is_same_v<Scalar, float> || std::is_same_v<Scalar, double>);
};

/// Returns a view of all `count` records. Record is any struct with members x, y, z, all float or all double,
/// adjacent in memory in this order. Throws std::invalid_argument if they are not adjacent.
template <typename Record>
PointView view_records(const Record* records, std::size_t count) {
  static_assert(has_xyz<Record>::value,
                "the point type must have members x, y and z, all float or all double");
  if (count == 0) return {};
  if (&records->y != &records->x + 1 || &records->z != &records->x + 2) {
    throw std::invalid_argument("the members x, y, z of the point type must be adjacent in this order");
  }
  PointView view = PointView::of(&records->x, sizeof(Record), count);
  view.readable -= static_cast<std::size_t>(view.data - reinterpret_cast<const std::byte*>(records));
  return view;
}

/// Returns a view of the points of a cloud that an index list selects, in the order of the list. The cloud
/// must be whole and in memory; the list must outlive the view. Throws std::out_of_range, naming the index,
/// if an index is outside the cloud, and std::invalid_argument if the cloud is a slice, has an index list or
/// has a source.
inline PointView select_points(const PointView& cloud, const std::int32_t* indices, std::size_t count) {
  if (cloud.source != nullptr || cloud.indices != nullptr || cloud.first != 0)
    throw std::invalid_argument("select_points: the cloud must be whole and in memory");
  for (std::size_t i = 0; i < count; ++i) {
    if (indices[i] >= 0 && static_cast<std::size_t>(indices[i]) < cloud.count) continue;
    throw std::out_of_range("point index " + std::to_string(indices[i]) + " is outside the cloud of " +
                            std::to_string(cloud.count) + " points");
  }
  PointView view = cloud;
  view.indices = indices;
  view.count = count;
  return view;
}

}  // namespace pcl_bv
