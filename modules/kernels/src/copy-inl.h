// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A block of points, loaded and judged once, for kernels that run over it several times.

// Included once per target by Highway's foreach_target.h.
#if defined(PCL_BV_COPY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_BV_COPY_INL_H_
#undef PCL_BV_COPY_INL_H_
#else
#define PCL_BV_COPY_INL_H_
#endif

#include <hwy/highway.h>

#include <array>

#include "load-inl.h"
#include "reach-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

// Whether no point of a block went beyond what is certainly valid.
template <class D, typename T = hn::TFromD<D>>
HWY_INLINE bool all_valid(D d, const T* center, V<D> x, V<D> y, V<D> z, V<D> total) {
  const auto low = no_low_reach(d);
  const T room = room_around<T>(center);
  auto reach_x = reach_higher(d, no_high_reach(d), x);
  auto reach_y = reach_higher(d, no_high_reach(d), y);
  auto reach_z = reach_higher(d, no_high_reach(d), z);
  return all_within(d, room, low, reach_x) && all_within(d, room, low, reach_y) &&
         all_within(d, room, low, reach_z) && sum_is_finite(d, total);
}

// Copies a block relative to the centre and lets `spread` grow to the greatest magnitudes. Returns whether
// all points are valid; if not, nothing that was written means anything. With `masked`, invalid points are
// replaced by the centre and counted.
template <Layout layout, bool masked, class D, typename T = hn::TFromD<D>>
bool copy_block(D d, const PointView& block, const T* center, T* points, std::array<double, 3>& spread,
                std::size_t& dropped) {
  const std::size_t n = hn::Lanes(d);
  auto spread_x = no_high_reach(d), spread_y = no_high_reach(d), spread_z = no_high_reach(d);
  [[maybe_unused]] auto total = hn::Zero(d);
  std::size_t valid_count = 0;
  for (std::size_t i = 0; i < block.count; i += n, points += 3 * n) {
    V<D> x, y, z;
    load_relative<layout, masked>(d, block, i, center, x, y, z, valid_count);
    hn::Store(x, d, points);
    hn::Store(y, d, points + n);
    hn::Store(z, d, points + 2 * n);
    if constexpr (!masked && sizeof(T) == 8) total = hn::Add(total, hn::Add(hn::Add(x, y), z));
    spread_x = reach_higher(d, spread_x, hn::Abs(x));
    spread_y = reach_higher(d, spread_y, hn::Abs(y));
    spread_z = reach_higher(d, spread_z, hn::Abs(z));
  }
  const auto x = high_reach(d, spread_x), y = high_reach(d, spread_y), z = high_reach(d, spread_z);
  dropped = 0;
  if constexpr (masked) {
    dropped = (block.count + n - 1) / n * n - valid_count;
  } else if (!all_valid(d, center, x, y, z, total)) {
    return false;
  }
  spread[0] = HWY_MAX(spread[0], static_cast<double>(hn::GetLane(hn::MaxOfLanes(d, x))));
  spread[1] = HWY_MAX(spread[1], static_cast<double>(hn::GetLane(hn::MaxOfLanes(d, y))));
  spread[2] = HWY_MAX(spread[2], static_cast<double>(hn::GetLane(hn::MaxOfLanes(d, z))));
  return true;
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
