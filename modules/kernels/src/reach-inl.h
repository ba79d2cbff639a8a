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
using IsFloat = std::enable_if_t<sizeof(hn::TFromD<D>) == 4>*;
template <class D>
using IsDouble = std::enable_if_t<sizeof(hn::TFromD<D>) == 8>*;
template <class D>
using Signed = hn::RebindToSigned<D>;
template <class D>
using Unsigned = hn::RebindToUnsigned<D>;

/// How far from the centre every point is certainly valid.
template <typename T>
T room_around(const T* center) {
  if (sizeof(T) == 4) return coordinate_limit<T>();
  T farthest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    farthest = HWY_MAX(farthest, HWY_MAX(center[axis], -center[axis]));
  return static_cast<T>(0.999) * (coordinate_limit<T>() - farthest);
}

template <class D, IsFloat<D> = nullptr>
HWY_INLINE V<Signed<D>> no_high_reach(D) {
  return hn::Zero(Signed<D>());
}
template <class D, IsFloat<D> = nullptr>
HWY_INLINE V<Unsigned<D>> no_low_reach(D) {
  return hn::Set(Unsigned<D>(), 0x80000000U);
}
template <class D, IsFloat<D> = nullptr>
HWY_INLINE V<Signed<D>> reach_higher(D, V<Signed<D>> reach, V<D> p) {
  reach = hn::Max(reach, hn::BitCast(Signed<D>(), p));
  hold(reach);
  return reach;
}
template <class D, IsFloat<D> = nullptr>
HWY_INLINE V<Unsigned<D>> reach_lower(D, V<Unsigned<D>> reach, V<D> p) {
  reach = hn::Max(reach, hn::BitCast(Unsigned<D>(), p));
  hold(reach);
  return reach;
}
/// As numbers >= 0.
template <class D, IsFloat<D> = nullptr>
HWY_INLINE V<D> high_reach(D d, V<Signed<D>> reach) {
  return hn::BitCast(d, reach);
}
template <class D, IsFloat<D> = nullptr>
HWY_INLINE V<D> low_reach(D d, V<Unsigned<D>> reach) {
  return hn::Abs(hn::BitCast(d, reach));
}
template <class D, IsFloat<D> = nullptr>
HWY_INLINE bool all_within(D d, float, V<Unsigned<D>> low, V<Signed<D>> high) {
  const auto greatest = hn::Set(Signed<D>(), 0x7F7FFFFF);  // of the finite floats
  const auto low_magnitude = hn::BitCast(Signed<D>(), low_reach(d, low));
  return hn::AllFalse(Signed<D>(), hn::Gt(hn::Max(high, low_magnitude), greatest));
}
template <class D, IsFloat<D> = nullptr>
HWY_INLINE bool sum_is_finite(D, V<D>) {
  return true;  // all_within() has seen to it
}

// Doubles: few sets have 64-bit integer maxima; the sum tells what minima and maxima may lose.
template <class D, IsDouble<D> = nullptr>
HWY_INLINE V<D> no_high_reach(D d) {
  return hn::Zero(d);
}
template <class D, IsDouble<D> = nullptr>
HWY_INLINE V<D> no_low_reach(D d) {
  return hn::Zero(d);
}
template <class D, IsDouble<D> = nullptr>
HWY_INLINE V<D> reach_higher(D, V<D> reach, V<D> p) {
  return hn::Max(reach, p);
}
template <class D, IsDouble<D> = nullptr>
HWY_INLINE V<D> reach_lower(D, V<D> reach, V<D> p) {
  return hn::Min(reach, p);
}
template <class D, IsDouble<D> = nullptr>
HWY_INLINE V<D> high_reach(D, V<D> reach) {
  return hn::Abs(reach);
}
template <class D, IsDouble<D> = nullptr>
HWY_INLINE V<D> low_reach(D, V<D> reach) {
  return hn::Abs(reach);
}
template <class D, IsDouble<D> = nullptr>
HWY_INLINE bool all_within(D d, double room, V<D> low, V<D> high) {
  const auto limit = hn::Set(d, room);
  return hn::AllTrue(d, hn::And(hn::Le(hn::Abs(low), limit), hn::Le(high, limit)));
}
template <class D, IsDouble<D> = nullptr>
HWY_INLINE bool sum_is_finite(D d, V<D> total) {
  return hn::AllTrue(d, hn::Le(hn::Abs(total), hn::Set(d, std::numeric_limits<double>::max())));
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
