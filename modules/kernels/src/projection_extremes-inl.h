// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Accumulates, in each lane, the largest projection above zero and the smallest projection below zero. Floats
// are compared as integers. Of two positive floats, the larger float is the larger signed integer. Of two
// negative floats, the float of larger magnitude is the larger unsigned integer. The maximum starts at 0 and
// the minimum at -0, so a number of the other sign never replaces them. Recent cores compute integer maxima
// on all four vector pipes, but float maxima on only two (26-DOP, AVX-512, Zen 5: 4500 instead of 3200
// Mpt/s). As integers, NaN and infinity exceed all finite numbers, so an invalid point is detected in the
// result.

// Compiled once per target of Highway's foreach_target.h.
#if defined(PCL_BV_PROJECTION_EXTREMES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_BV_PROJECTION_EXTREMES_INL_H_
#undef PCL_BV_PROJECTION_EXTREMES_INL_H_
#else
#define PCL_BV_PROJECTION_EXTREMES_INL_H_
#endif

#include <hwy/highway.h>

#include <limits>

#include "load-inl.h"
#include "pcl_bv/numeric/directions.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

template <class D>
using Signed = hn::RebindToSigned<D>;
template <class D>
using Unsigned = hn::RebindToUnsigned<D>;

/// High and Low are the types of the accumulators of projections above and below zero. Doubles are compared
/// as doubles, since few instruction sets have 64-bit integer maxima. Minima and maxima of doubles may lose a
/// NaN, but sum_is_finite() finds it.
template <class D>
inline constexpr bool kIsFloat = sizeof(hn::TFromD<D>) == 4;
template <class D>
using High = std::conditional_t<kIsFloat<D>, Signed<D>, D>;
template <class D>
using Low = std::conditional_t<kIsFloat<D>, Unsigned<D>, D>;

/// Returns the distance from the centre, along each axis, within which every point is certainly valid.
template <typename T>
T valid_distance(const T* center) {
  if (sizeof(T) == 4) return coordinate_limit<T>();
  T farthest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    farthest = HWY_MAX(farthest, HWY_MAX(center[axis], -center[axis]));
  return static_cast<T>(0.999) * (coordinate_limit<T>() - farthest);
}

template <class D>
HWY_INLINE V<High<D>> zero_maximum(D) {
  return hn::Zero(High<D>());
}
template <class D>
HWY_INLINE V<Low<D>> zero_minimum(D d) {
  return hn::BitCast(Low<D>(), hn::SignBit(d));
}
template <class D>
HWY_INLINE V<High<D>> update_maximum(D, V<High<D>> maximum, V<D> p) {
  maximum = hn::Max(maximum, hn::BitCast(High<D>(), p));
  if constexpr (kIsFloat<D>) keep_in_register(maximum);
  return maximum;
}
template <class D>
HWY_INLINE V<Low<D>> update_minimum(D, V<Low<D>> minimum, V<D> p) {
  if constexpr (!kIsFloat<D>) return hn::Min(minimum, p);
  minimum = hn::Max(minimum, hn::BitCast(Low<D>(), p));
  keep_in_register(minimum);
  return minimum;
}
/// maximum_projection() and minimum_magnitude() return the accumulated projections as numbers >= 0.
template <class D>
HWY_INLINE V<D> maximum_projection(D d, V<High<D>> maximum) {
  return hn::BitCast(d, maximum);
}
template <class D>
HWY_INLINE V<D> minimum_magnitude(D d, V<Low<D>> minimum) {
  return hn::Abs(hn::BitCast(d, minimum));
}
template <class D, typename T = hn::TFromD<D>>
HWY_INLINE bool all_within(D d, [[maybe_unused]] T distance, V<Low<D>> low, V<High<D>> high) {
  if constexpr (kIsFloat<D>) {
    const auto greatest = hn::Set(Signed<D>(), 0x7F7FFFFF);  // largest finite float
    const auto low_magnitude = hn::BitCast(Signed<D>(), minimum_magnitude(d, low));
    return hn::AllFalse(Signed<D>(), hn::Gt(hn::Max(high, low_magnitude), greatest));
  } else {
    const auto limit = hn::Set(d, distance);
    return hn::AllTrue(d, hn::And(hn::Le(hn::Abs(low), limit), hn::Le(high, limit)));
  }
}
/// Returns whether a sum of all coordinates is finite. Always true for floats, because all_within() has
/// already found any NaN.
template <class D>
HWY_INLINE bool sum_is_finite(D d, V<D> total) {
  const auto greatest = hn::Set(d, std::numeric_limits<hn::TFromD<D>>::max());
  return kIsFloat<D> || hn::AllTrue(d, hn::Le(hn::Abs(total), greatest));
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv::detail
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
