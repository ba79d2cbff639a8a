// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/kernels/run_boxes.h"

#include <algorithm>

#include "preconditions.h"
#include "references.h"
#include "run_extremes.h"
#include "targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "run_boxes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "load-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv::detail {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

// Compares explicitly, because Min and Max treat NaN differently on different instruction sets.
template <class D>
HWY_INLINE void grow(D, V<D> v, V<D>& low, V<D>& high) {
  low = hn::IfThenElse(hn::Lt(v, low), v, low);
  high = hn::IfThenElse(hn::Gt(v, high), v, high);
}

template <Layout layout, typename T>
RunExtremes<T> extremes_of(const PointView& points, std::size_t begin) {
  const Tag<T> d;
  const auto most = hn::Set(d, RunExtremes<T>::kMost), least = hn::Neg(most);
  auto low_x = most, low_y = most, low_z = most, high_x = least, high_y = least, high_z = least;
  const std::size_t end = HWY_MIN(begin + kRunPoints, points.count);
  for (std::size_t i = begin; i < end; i += hn::Lanes(d)) {
    V<decltype(d)> x, y, z;
    if (HWY_LIKELY(i + hn::Lanes(d) <= points.count)) {
      load_packet<layout>(d, points, i, x, y, z);
    } else {
      T pad[3];
      load_point(points, i, pad);
      load_padded(d, points, i, points.count - i, pad, x, y, z);
    }
    grow(d, x, low_x, high_x);
    grow(d, y, low_y, high_y);
    grow(d, z, low_z, high_z);
  }
  const auto least_of = [&](V<decltype(d)> v) { return hn::GetLane(hn::MinOfLanes(d, v)); };
  const auto greatest_of = [&](V<decltype(d)> v) { return hn::GetLane(hn::MaxOfLanes(d, v)); };
  return {{least_of(low_x), least_of(low_y), least_of(low_z)},
          {greatest_of(high_x), greatest_of(high_y), greatest_of(high_z)}};
}

void run_boxes(const PointView& points, RunBox* boxes) {
  for_layout(points, [&]<Layout layout, typename T>() {
    for (std::size_t begin = 0; begin < points.count; begin += kRunPoints)
      boxes[begin / kRunPoints] = extremes_of<layout, T>(points, begin).box();
  });
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_bv::detail {

void run_boxes(UsableIsa isa, const PointView& points, RunBox* boxes) {
  static constexpr KernelTable kTable = PCL_BV_KERNEL_TABLE(run_boxes, &run_boxes_reference);
  require_in_memory(points);
  kTable[isa](points, boxes);
}

}  // namespace pcl_bv::detail
#endif  // HWY_ONCE
