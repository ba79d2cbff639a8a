// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/kernels/deskew.h"

#include <cstring>

#include "preconditions.h"
#include "references.h"
#include "screw_motion.h"
#include "targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "deskew.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "load-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv::detail {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

template <class D>
HWY_INLINE V<D> load_seconds(D d, const float* seconds) {
  if constexpr (sizeof(hn::TFromD<D>) == 4) {
    return hn::LoadU(d, seconds);
  } else {
    return hn::PromoteTo(d, hn::LoadU(hn::Rebind<float, D>(), seconds));
  }
}

// Returns the series number `k` of kScrewSeries at s.
template <class D>
HWY_INLINE V<D> series(D d, std::size_t k, V<D> s) {
  using T = hn::TFromD<D>;
  const auto& c = kScrewSeries[k];
  auto sum = hn::Set(d, static_cast<T>(c[3]));
  for (std::size_t i = 3; i-- > 0;)
    sum = hn::Add(hn::Set(d, static_cast<T>(c[i])), hn::Mul(s, sum));
  return sum;
}

template <class D, typename T>
HWY_INLINE void move_packet(D d, const ScrewMotion<T>& motion, V<D> t, V<D> (&p)[3]) {
  const auto constant = [d](T value) { return hn::Set(d, value); };
  const auto tt = hn::Mul(t, t);
  const auto s = hn::Mul(constant(motion.ww), tt);
  const auto a = hn::Mul(t, series(d, 0, s)), b = hn::Mul(tt, series(d, 1, s)),
             c = hn::Mul(hn::Mul(tt, t), series(d, 2, s));
  const auto& w = motion.w;
  const auto cross = [&](const V<D>(&q)[3], std::size_t i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    return hn::Sub(hn::Mul(constant(w[j]), q[k]), hn::Mul(constant(w[k]), q[j]));
  };
  const V<D> once[3] = {cross(p, 0), cross(p, 1), cross(p, 2)};
  const auto zero = hn::Zero(d);
  const auto no_return = hn::And(hn::And(hn::Eq(p[0], zero), hn::Eq(p[1], zero)), hn::Eq(p[2], zero));
  V<D> moved[3];
  for (std::size_t i = 0; i < 3; ++i) {
    const auto twice = hn::Add(cross(once, i), constant(motion.wv[i]));
    const auto along = hn::Add(hn::Mul(t, constant(motion.v[i])), hn::Mul(c, constant(motion.wwv[i])));
    const auto step = hn::Add(hn::Mul(a, once[i]), hn::Add(hn::Mul(b, twice), along));
    moved[i] = hn::Add(p[i], step);
  }
  const auto moves = hn::AndNot(no_return, valid_lanes(d, moved[0], moved[1], moved[2]));
  for (std::size_t i = 0; i < 3; ++i)
    p[i] = hn::IfThenElse(moves, moved[i], p[i]);
}

template <Layout layout, typename T>
void deskew_of(const PointView& points, const float* seconds, const SensorMotion& sensor, std::byte* xyz) {
  // Layout::packed16 loads the points of a packet in another order.
  constexpr Layout in_order = layout == Layout::packed16 && !HWY_HAVE_SCALABLE ? Layout::wide : layout;
  const Tag<T> d;
  const std::size_t lanes = hn::Lanes(d);
  const ScrewMotion<T> motion(sensor);
  T* const out = reinterpret_cast<T*>(xyz);
  std::size_t i = 0;
  for (; i + lanes <= points.count; i += lanes) {
    V<decltype(d)> p[3];
    load_packet<in_order>(d, points, i, p[0], p[1], p[2]);
    move_packet(d, motion, load_seconds(d, seconds + i), p);
    hn::StoreInterleaved3(p[0], p[1], p[2], d, out + 3 * i);
  }
  const std::size_t rest = points.count - i;
  if (rest == 0) return;
  constexpr std::size_t kMaxLanes = kGroupBytes / sizeof(T);
  const T pad[3] = {};
  HWY_ALIGN float times[kMaxLanes] = {};
  HWY_ALIGN T moved[3 * kMaxLanes];
  std::memcpy(times, seconds + i, rest * sizeof(float));
  V<decltype(d)> p[3];
  load_padded(d, points, i, rest, pad, p[0], p[1], p[2]);
  move_packet(d, motion, load_seconds(d, times), p);
  hn::StoreInterleaved3(p[0], p[1], p[2], d, moved);
  std::memcpy(out + 3 * i, moved, 3 * rest * sizeof(T));
}

void deskew(const PointView& points, const float* seconds, const SensorMotion& motion, std::byte* xyz) {
  for_layout(points,
             [&]<Layout layout, typename T>() { deskew_of<layout, T>(points, seconds, motion, xyz); });
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_bv::detail {

void deskew(UsableIsa isa, const PointView& points, const float* seconds, const SensorMotion& motion,
            std::byte* xyz) {
  static constexpr KernelTable kTable = PCL_BV_KERNEL_TABLE(deskew, &deskew_reference);
  require_in_memory(points);
  kTable[isa](points, seconds, motion, xyz);
}

}  // namespace pcl_bv::detail
#endif  // HWY_ONCE
