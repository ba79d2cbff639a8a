// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Copies points of any layout to groups (point_view.h) in one pass and in order. Used by PointGroups, and by
// kernels in which a lane must hold the same points on every instruction set.

// Compiled once per target of Highway's foreach_target.h.
#if defined(PCL_BV_COPY_TO_GROUPS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_BV_COPY_TO_GROUPS_INL_H_
#undef PCL_BV_COPY_TO_GROUPS_INL_H_
#else
#define PCL_BV_COPY_TO_GROUPS_INL_H_
#endif

#include <hwy/highway.h>

#include "load-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

/// Loads consecutive numbers of a group as double.
template <class D>
HWY_INLINE V<D> load_as_double(D d, const float* p) {
  return hn::PromoteTo(d, hn::Load(hn::Rebind<float, D>(), p));
}
template <class D>
HWY_INLINE V<D> load_as_double(D d, const double* p) {
  return hn::Load(d, p);
}

/// Writes the points as groups. The point `pad` fills the rest of the last group. If `masked`, `pad` must be
/// valid and also replaces each invalid point. Returns the number of valid points if `masked`, else 0.
template <Layout layout, bool masked, typename T>
std::size_t copy_to_groups(const PointView& points, const T* pad, T* groups) {
  constexpr std::size_t per_group = kGroupBytes / sizeof(T);
  const Tag<T> d;
  const std::size_t n = hn::Lanes(d);
  const std::size_t padded = (points.count + per_group - 1) / per_group * per_group;
  std::size_t valid_count = 0;
  for (std::size_t i = 0; i < padded; i += n) {
    V<Tag<T>> x, y, z;
    if (HWY_LIKELY(i + n <= points.count)) {
      load_packet_in_order<layout>(d, points, i, x, y, z);
    } else {
      load_tail_in_order<layout>(d, points, i, points.count - HWY_MIN(i, points.count), pad, x, y, z);
    }
    if constexpr (masked) {
      const auto valid = valid_lanes(d, x, y, z);
      valid_count += hn::CountTrue(d, valid);
      x = hn::IfThenElse(valid, x, hn::Set(d, pad[0]));
      y = hn::IfThenElse(valid, y, hn::Set(d, pad[1]));
      z = hn::IfThenElse(valid, z, hn::Set(d, pad[2]));
    }
    T* lanes = groups + i / per_group * (3 * per_group) + i % per_group;
    hn::Store(x, d, lanes);
    hn::Store(y, d, lanes + per_group);
    hn::Store(z, d, lanes + 2 * per_group);
  }
  return masked ? valid_count - (padded - points.count) : 0;
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv::detail
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
