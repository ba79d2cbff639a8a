// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Copies points to groups, with a few loads and a transpose per packet. The speed of the copy is limited by
// memory, not by the shuffles.

#include "pcl_bv/points/point_groups.h"

#include "preconditions.h"
#include "references.h"
#include "targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "point_groups.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "copy_to_groups-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv::detail {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

void fill_groups(const PointView& points, std::size_t pad, std::byte* groups) {
  for_layout(points, [&]<Layout layout, typename T>() {
    T point[3];
    load_point(points, pad, point);
    copy_to_groups<layout, false>(points, point, reinterpret_cast<T*>(groups));
  });
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_bv::detail {
namespace {

// Returns the position of the last valid point, or of the last point if no point is valid. The search is
// short, because the last valid point is mostly near the end.
std::size_t padding_point(const PointView& points) {
  for (std::size_t i = points.count; i-- > 0;) {
    if (is_valid(load_point(points, i))) return i;
  }
  return points.count - 1;
}

void fill_groups(UsableIsa isa, const PointView& points, std::byte* groups) {
  static constexpr KernelTable kTable = PCL_BV_KERNEL_TABLE(fill_groups, &fill_groups_reference);
  kTable[isa](points, padding_point(points), groups);
}

}  // namespace
}  // namespace pcl_bv::detail

namespace pcl_bv {

PointGroups::PointGroups(const PointView& points, UsableIsa isa) {
  assign(points, isa);
}

void PointGroups::assign(const PointView& points, UsableIsa isa) {
  detail::require_in_memory(points);
  const std::size_t points_per_group = kGroupBytes / size_of(points.scalar);
  const std::size_t groups = (points.count + points_per_group - 1) / points_per_group;
  if (groups > groups_.capacity()) groups_.clear();  // so that resize() copies no old contents
  groups_.resize(groups);
  size_ = points.count;
  scalar_ = points.scalar;
  if (groups > 0) detail::fill_groups(isa, points, groups_.front().lanes);
}

PointView PointGroups::view() const {
  PointView view;
  view.data = groups_.empty() ? nullptr : groups_.front().lanes;
  view.count = size();
  view.scalar = scalar_;
  view.order = PointOrder::groups;
  return view;
}

}  // namespace pcl_bv
#endif  // HWY_ONCE
