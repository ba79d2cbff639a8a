// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Points in memory to packets of x, y and z lanes, for the target being compiled. The order of points inside
// a packet is free: minima and maxima do not care.

// Included once per target by Highway's foreach_target.h.
#if defined(PCL_BV_LOAD_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_BV_LOAD_INL_H_
#undef PCL_BV_LOAD_INL_H_
#else
#define PCL_BV_LOAD_INL_H_
#endif

#include <hwy/highway.h>

#include "pcl_bv/kernels/point_view.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

/// How a packet is read. What a layout assumes of the view is said by layout_of().
enum class Layout {
  packed12,  ///< x y z x y z ...
  packed16,  ///< pcl::PointXYZ: one 16-byte load per point, all contiguous
  wide,      ///< 16 readable bytes per point, any stride or an index list
  any        ///< coordinate by coordinate
};

inline Layout layout_of(const PointView& points) {
  if (points.scalar != ScalarType::float32) return Layout::any;
  if (points.indices == nullptr && points.stride == 12) return Layout::packed12;
  if (points.readable < 16 || HWY_HAVE_SCALABLE) return Layout::any;
  return points.indices == nullptr && points.stride == 16 ? Layout::packed16 : Layout::wide;
}

template <class D>
using V = hn::Vec<D>;

// Points first, first + 1, ... as one 128-bit block each. Recursion on the vector's size ends at one block.
template <class D>
HWY_INLINE V<D> load_blocks(D d, const PointView& points, std::size_t first) {
  if constexpr (hn::MaxLanes(D()) <= 4) {
    return hn::LoadU(d, reinterpret_cast<const float*>(points.address(first)));
  } else {
    const hn::Half<D> half;
    return hn::Combine(d, load_blocks(half, points, first + hn::Lanes(half) / 4),
                       load_blocks(half, points, first));
  }
}

// Four registers of whole points (x y z and a fourth lane of anything) to x, y and z: a transpose inside each
// 128-bit block, seven shuffles, since extents do not ask for the points' order.
template <class D>
HWY_INLINE void transpose(D d, V<D> a, V<D> b, V<D> c, V<D> e, V<D>& x, V<D>& y, V<D>& z) {
  const hn::Repartition<double, D> pairs;
  const auto ab_xy = hn::BitCast(pairs, hn::InterleaveLower(d, a, b));
  const auto ab_zw = hn::BitCast(pairs, hn::InterleaveUpper(d, a, b));
  const auto ce_xy = hn::BitCast(pairs, hn::InterleaveLower(d, c, e));
  const auto ce_zw = hn::BitCast(pairs, hn::InterleaveUpper(d, c, e));
  x = hn::BitCast(d, hn::InterleaveLower(pairs, ab_xy, ce_xy));
  y = hn::BitCast(d, hn::InterleaveUpper(pairs, ab_xy, ce_xy));
  z = hn::BitCast(d, hn::InterleaveLower(pairs, ab_zw, ce_zw));
}

/// Loads up to one packet, point by point; lanes past `count` repeat the point at `pad` (never zeros).
template <class D, typename T = hn::TFromD<D>>
HWY_INLINE void load_few(D d, const PointView& points, std::size_t first, std::size_t count, const T* pad,
                         V<D>& x, V<D>& y, V<D>& z) {
  HWY_ALIGN T lanes[3][HWY_MAX_BYTES / sizeof(T)];
  for (std::size_t i = 0; i < hn::Lanes(d); ++i) {
    T v[3];
    std::memcpy(v, i < count ? points.address(first + i) : reinterpret_cast<const std::byte*>(pad), sizeof v);
    for (std::size_t axis = 0; axis < 3; ++axis)
      lanes[axis][i] = v[axis];
  }
  x = hn::Load(d, lanes[0]);
  y = hn::Load(d, lanes[1]);
  z = hn::Load(d, lanes[2]);
}

/// Loads one full packet of points from `first` on.
template <Layout layout, class D>
HWY_INLINE void load_packet(D d, const PointView& points, std::size_t first, V<D>& x, V<D>& y, V<D>& z) {
  using T = hn::TFromD<D>;
  if constexpr (layout == Layout::packed12) {
    hn::LoadInterleaved3(d, reinterpret_cast<const float*>(points.data) + 3 * first, x, y, z);
  } else if constexpr (layout == Layout::packed16) {
    const std::size_t n = hn::Lanes(d);
    const float* p = reinterpret_cast<const float*>(points.data) + 4 * first;
    transpose(d, hn::LoadU(d, p), hn::LoadU(d, p + n), hn::LoadU(d, p + 2 * n), hn::LoadU(d, p + 3 * n), x, y,
              z);
  } else if constexpr (layout == Layout::wide) {
    const std::size_t quarter = hn::Lanes(d) / 4;
    transpose(d, load_blocks(d, points, first), load_blocks(d, points, first + quarter),
              load_blocks(d, points, first + 2 * quarter), load_blocks(d, points, first + 3 * quarter), x, y,
              z);
  } else {
    load_few(d, points, first, hn::Lanes(d), static_cast<const T*>(nullptr), x, y, z);
  }
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
