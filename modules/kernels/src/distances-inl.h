// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Squared distances of packets, for the target being compiled. float_limit() relates distances in float to
// distances in double with a proven bound. Distances in double are computed in a fixed order of operations,
// none of which is fused.

// Compiled once per target of Highway's foreach_target.h.
#if defined(PCL_BV_DISTANCES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_BV_DISTANCES_INL_H_
#undef PCL_BV_DISTANCES_INL_H_
#else
#define PCL_BV_DISTANCES_INL_H_
#endif

#include <hwy/highway.h>

#include <limits>

#include "load-inl.h"
#include "pcl_bv/kernels/distances.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv::detail {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

// Returns the larger of a running maximum and a candidate. A candidate that is NaN is ignored.
template <class D>
HWY_INLINE V<D> max_or_keep(D, V<D> candidate, V<D> running) {
#if HWY_ARCH_X86
  return hn::Max(candidate, running);  // x86 returns the second operand if either is NaN
#else
  return hn::IfThenElse(hn::Gt(candidate, running), candidate, running);
#endif
}

// Subtracts the centre. If `scaled`, also multiplies by the centre's scale, which is 1 for float points.
template <bool scaled, class D>
HWY_INLINE void subtract(D d, const DistanceCenter& center, V<D>& x, V<D>& y, V<D>& z) {
  x = hn::Sub(x, hn::Set(d, center.x));
  y = hn::Sub(y, hn::Set(d, center.y));
  z = hn::Sub(z, hn::Set(d, center.z));
  if constexpr (scaled) {
    const auto scale = hn::Set(d, center.scale);
    x = hn::Mul(x, scale);
    y = hn::Mul(y, scale);
    z = hn::Mul(z, scale);
  }
}

template <class V_>
HWY_INLINE V_ sum_of_squares(V_ x, V_ y, V_ z) {
  return hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
}

// Same as sum_of_squares(), but with other roundings on instruction sets that fuse. It may only reject.
template <class V_>
HWY_INLINE V_ fused_squares(V_ x, V_ y, V_ z) {
  return hn::MulAdd(z, z, hn::MulAdd(y, y, hn::Mul(x, x)));
}

// Applies STEP(x, y, z) to a packet's coordinates in double. A packet of doubles takes one step; a packet of
// floats takes one step for each half.
#define PCL_BV_IN_DOUBLE(T, d, dd, x, y, z, STEP)                 \
  do {                                                            \
    if constexpr (sizeof(T) == 8) {                               \
      STEP(x, y, z)                                               \
    } else {                                                      \
      const hn::Half<decltype(d)> half;                           \
      {                                                           \
        auto lower_x = hn::PromoteTo(dd, hn::LowerHalf(half, x)); \
        auto lower_y = hn::PromoteTo(dd, hn::LowerHalf(half, y)); \
        auto lower_z = hn::PromoteTo(dd, hn::LowerHalf(half, z)); \
        STEP(lower_x, lower_y, lower_z)                           \
      }                                                           \
      {                                                           \
        auto upper_x = hn::PromoteTo(dd, hn::UpperHalf(half, x)); \
        auto upper_y = hn::PromoteTo(dd, hn::UpperHalf(half, y)); \
        auto upper_z = hn::PromoteTo(dd, hn::UpperHalf(half, z)); \
        STEP(upper_x, upper_y, upper_z)                           \
      }                                                           \
    }                                                             \
  } while (false)

// A centre as the sum of two floats per coordinate, namely the nearest finite float (head) and the remainder
// (tail). The head is finite, because an infinite head would make each distance NaN, and the float filter
// would reject all points.
struct FloatCenter {
  explicit FloatCenter(const DistanceCenter& c)
      : head{nearest(c.x), nearest(c.y), nearest(c.z)},
        tail{static_cast<float>(c.x - static_cast<double>(head[0])),
             static_cast<float>(c.y - static_cast<double>(head[1])),
             static_cast<float>(c.z - static_cast<double>(head[2]))} {}
  static float nearest(double c) {
    constexpr double most = std::numeric_limits<float>::max();
    return static_cast<float>(HWY_MAX(-most, HWY_MIN(c, most)));
  }
  float head[3];
  float tail[3];
};

template <class D>
HWY_INLINE V<D> distances_in_float(D d, const FloatCenter& center, V<D> x, V<D> y, V<D> z) {
  const auto qx = hn::Sub(hn::Sub(x, hn::Set(d, center.head[0])), hn::Set(d, center.tail[0]));
  const auto qy = hn::Sub(hn::Sub(y, hn::Set(d, center.head[1])), hn::Set(d, center.tail[1]));
  const auto qz = hn::Sub(hn::Sub(z, hn::Set(d, center.head[2])), hn::Set(d, center.tail[2]));
  return hn::MulAdd(qz, qz, hn::MulAdd(qy, qy, hn::Mul(qx, qx)));
}

// Returns a threshold. Every point whose squared distance in float is at most the threshold has a
// squared_distance() below `limit`. The threshold is negative if no float has this property.
//
// Let u = 2^-24. The error of a coordinate of q is at most 2.1 u times the coordinate plus 3.1 u times the
// rounding error of the centre, |c - head|. No float is nearer to the centre c than the head, so |c - head|
// is at most the coordinate, and the total error is at most 5.2 u times the coordinate. Squares, sums and
// products add a relative error below 4 u, or 2^-147 if they underflow. So if the squared distance in float
// is f, squared_distance() is at most f (1 + 2^-20) + 2^-140.
HWY_INLINE float float_limit(double limit) {
  const double least = (limit - 0x1p-139) * (1 - 0x1p-18);
  constexpr double most = std::numeric_limits<float>::max();
  return least < 0 ? -1.0F : static_cast<float>(HWY_MIN(least, most));
}

// The centre and the limit for float arithmetic. If the squared distance of a point in float is at most
// `limit`, its squared_distance() is below scan_limit.
struct FloatRejection {
  FloatRejection(const DistanceCenter& c, double scan_limit) : center(c), limit(float_limit(scan_limit)) {}
  FloatCenter center;
  float limit;
};

// Consecutive packets of a view. Float arithmetic can reject all points of a run with one test.
struct Run {
  std::size_t begin, end;
};

template <class D>
HWY_INLINE Run run_at(D d, std::size_t begin, std::size_t count) {
  return {begin, HWY_MIN(begin + kBoundPoints * hn::Lanes(d), count)};
}

// Returns, for each lane, the largest squared distance in float of the points of a run. NaN is ignored. The
// result is infinite if a distance overflows or a point is infinite.
template <Layout layout, class D>
HWY_INLINE V<D> greatest_in_float(D d, const PointView& points, Run run, const FloatCenter& center) {
  const std::size_t n = hn::Lanes(d);
  auto greatest = hn::Set(d, -1.0F);
  V<D> x, y, z;
  if (run.end - run.begin == kBoundPoints * n) {
    // Loads two packets at a time and does not test for the end. This increases the speed from 4.1 to 5.8
    // Gpt/s (AVX-512).
    auto other = greatest;
    for (std::size_t i = run.begin; i < run.end; i += 2 * n) {
      load_packet<layout>(d, points, i, x, y, z);
      greatest = max_or_keep(d, distances_in_float(d, center, x, y, z), greatest);
      load_packet<layout>(d, points, i + n, x, y, z);
      other = max_or_keep(d, distances_in_float(d, center, x, y, z), other);
    }
    return hn::Max(greatest, other);
  }
  for (std::size_t i = run.begin; i < run.end; i += n) {
    load_packet_or_tail<layout>(d, points, i, x, y, z);
    greatest = max_or_keep(d, distances_in_float(d, center, x, y, z), greatest);
  }
  return greatest;
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv::detail
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
