// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Views of arrays of point structs, such as PCL's. Does not depend on any particular point type.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

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

/// Returns a view of a vector of points: of structs with members x, y, z as view_records() takes them, or of
/// fixed-size arrays of float or double whose first three elements are x, y, z, such as Eigen::Vector3f,
/// Eigen::Vector4d or std::array<float, 3>. The vector must outlive the view.
template <typename Record, typename Allocator>
PointView view(const std::vector<Record, Allocator>& points) {
  if constexpr (has_xyz<Record>::value) {
    return view_records(points.data(), points.size());
  } else {
    using Scalar = std::remove_cv_t<std::remove_pointer_t<decltype(std::declval<const Record&>().data())>>;
    static_assert(std::is_trivially_destructible_v<Record> && sizeof(Record) >= 3 * sizeof(Scalar),
                  "the point type must hold at least three coordinates itself");
    if (points.empty()) return {};
    return PointView::of(points.data()->data(), sizeof(Record), points.size());
  }
}
template <typename Record, typename Allocator>
PointView view(const std::vector<Record, Allocator>&& points) = delete;  // the view would outlive the points

}  // namespace pcl_bv
