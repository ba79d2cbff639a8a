// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// How far the lanes of projections reach on both sides of zero. Floats are compared as integers: of two
// floats the greater positive one is the greater signed integer, the greater in magnitude of two negative
// ones the greater unsigned one; zero, which is inside the extent, hides the others. Integer maxima run on
// all four vector pipes of recent cores, those of floats on two (26-DOP, AVX-512, Zen 5: 4500 Mpt/s for
// 3200), and NaN and infinity stay in the result to tell that a point was not valid.

// Included once per target by Highway's foreach_target.h.
#if defined(PCL_BV_REACH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_BV_REACH_INL_H_
#undef PCL_BV_REACH_INL_H_
#else
#define PCL_BV_REACH_INL_H_
#endif

#include <hwy/highway.h>

#include <limits>

#include "load-inl.h"
#include "pcl_bv/numeric/directions.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

template <class D>
using Signed = hn::RebindToSigned<D>;
template <class D>
using Unsigned = hn::RebindToUnsigned<D>;

/// What the reach above and below zero is held in. Doubles stay doubles, since few sets have 64-bit integer
/// maxima: minima and maxima may then lose a NaN, which the sum tells.
template <class D>
inline constexpr bool kIsFloat = sizeof(hn::TFromD<D>) == 4;
template <class D>
using High = std::conditional_t<kIsFloat<D>, Signed<D>, D>;
template <class D>
using Low = std::conditional_t<kIsFloat<D>, Unsigned<D>, D>;

/// How far from the centre every point is certainly valid.
template <typename T>
T room_around(const T* center) {
  if (sizeof(T) == 4) return coordinate_limit<T>();
  T farthest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    farthest = HWY_MAX(farthest, HWY_MAX(center[axis], -center[axis]));
  return static_cast<T>(0.999) * (coordinate_limit<T>() - farthest);
}

template <class D>
HWY_INLINE V<High<D>> no_high_reach(D) {
  return hn::Zero(High<D>());
}
template <class D>
HWY_INLINE V<Low<D>> no_low_reach(D d) {
  return hn::BitCast(Low<D>(), hn::SignBit(d));
}
template <class D>
HWY_INLINE V<High<D>> reach_higher(D, V<High<D>> reach, V<D> p) {
  reach = hn::Max(reach, hn::BitCast(High<D>(), p));
  if constexpr (kIsFloat<D>) hold(reach);
  return reach;
}
template <class D>
HWY_INLINE V<Low<D>> reach_lower(D, V<Low<D>> reach, V<D> p) {
  if constexpr (!kIsFloat<D>) return hn::Min(reach, p);
  reach = hn::Max(reach, hn::BitCast(Low<D>(), p));
  hold(reach);
  return reach;
}
/// As numbers >= 0.
template <class D>
HWY_INLINE V<D> high_reach(D d, V<High<D>> reach) {
  return hn::BitCast(d, reach);
}
template <class D>
HWY_INLINE V<D> low_reach(D d, V<Low<D>> reach) {
  return hn::Abs(hn::BitCast(d, reach));
}
template <class D, typename T = hn::TFromD<D>>
HWY_INLINE bool all_within(D d, [[maybe_unused]] T room, V<Low<D>> low, V<High<D>> high) {
  if constexpr (kIsFloat<D>) {
    const auto greatest = hn::Set(Signed<D>(), 0x7F7FFFFF);  // of the finite floats
    const auto low_magnitude = hn::BitCast(Signed<D>(), low_reach(d, low));
    return hn::AllFalse(Signed<D>(), hn::Gt(hn::Max(high, low_magnitude), greatest));
  } else {
    const auto limit = hn::Set(d, room);
    return hn::AllTrue(d, hn::And(hn::Le(hn::Abs(low), limit), hn::Le(high, limit)));
  }
}
/// Of floats all_within() has seen to it.
template <class D>
HWY_INLINE bool sum_is_finite(D d, V<D> total) {
  const auto greatest = hn::Set(d, std::numeric_limits<hn::TFromD<D>>::max());
  return kIsFloat<D> || hn::AllTrue(d, hn::Le(hn::Abs(total), greatest));
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
