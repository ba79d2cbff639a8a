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

// Returns a p - b q.
template <class D, typename T>
HWY_INLINE V<D> difference(D d, T a, V<D> p, T b, V<D> q) {
  return hn::Sub(hn::Mul(hn::Set(d, a), p), hn::Mul(hn::Set(d, b), q));
}

// Returns a coordinate of the moved points. `once` and `twice` are that coordinate of w x p and w x (w x p);
// a, b and c are the factors of ScrewMotion at the time t.
template <class D, typename T>
HWY_INLINE V<D> moved_coordinate(D d, const ScrewMotion<T>& motion, std::size_t axis, V<D> p, V<D> once,
                                 V<D> twice, V<D> t, V<D> a, V<D> b, V<D> c) {
  const auto along =
      hn::Add(hn::Mul(t, hn::Set(d, motion.v[axis])), hn::Mul(c, hn::Set(d, motion.wwv[axis])));
  const auto across = hn::Mul(b, hn::Add(twice, hn::Set(d, motion.wv[axis])));
  return hn::Add(p, hn::Add(hn::Mul(a, once), hn::Add(across, along)));
}

// Vectors of scalable instruction sets cannot be elements of arrays, so each coordinate has a variable.
template <class D, typename T>
HWY_INLINE void move_packet(D d, const ScrewMotion<T>& motion, V<D> t, V<D>& x, V<D>& y, V<D>& z) {
  const auto tt = hn::Mul(t, t);
  const auto s = hn::Mul(hn::Set(d, motion.ww), tt);
  const auto a = hn::Mul(t, series(d, 0, s)), b = hn::Mul(tt, series(d, 1, s)),
             c = hn::Mul(hn::Mul(tt, t), series(d, 2, s));
  const auto& w = motion.w;
  const auto once_x = difference(d, w[1], z, w[2], y), once_y = difference(d, w[2], x, w[0], z),
             once_z = difference(d, w[0], y, w[1], x);
  const auto twice_x = difference(d, w[1], once_z, w[2], once_y),
             twice_y = difference(d, w[2], once_x, w[0], once_z),
             twice_z = difference(d, w[0], once_y, w[1], once_x);
  const auto moved_x = moved_coordinate(d, motion, 0, x, once_x, twice_x, t, a, b, c),
             moved_y = moved_coordinate(d, motion, 1, y, once_y, twice_y, t, a, b, c),
             moved_z = moved_coordinate(d, motion, 2, z, once_z, twice_z, t, a, b, c);
  const auto zero = hn::Zero(d);
  const auto no_return = hn::And(hn::And(hn::Eq(x, zero), hn::Eq(y, zero)), hn::Eq(z, zero));
  const auto moves = hn::AndNot(no_return, valid_lanes(d, moved_x, moved_y, moved_z));
  x = hn::IfThenElse(moves, moved_x, x);
  y = hn::IfThenElse(moves, moved_y, y);
  z = hn::IfThenElse(moves, moved_z, z);
}

template <Layout layout, typename T>
void deskew_of(const PointView& points, const float* seconds, const SensorMotion& sensor, std::byte* xyz) {
  const Tag<T> d;
  const std::size_t lanes = hn::Lanes(d);
  const ScrewMotion<T> motion(sensor);
  T* const out = reinterpret_cast<T*>(xyz);
  V<decltype(d)> x, y, z;
  std::size_t i = 0;
  for (; i + lanes <= points.count; i += lanes) {
    load_packet_in_order<layout>(d, points, i, x, y, z);
    move_packet(d, motion, load_seconds(d, seconds + i), x, y, z);
    hn::StoreInterleaved3(x, y, z, d, out + 3 * i);
  }
  const std::size_t rest = points.count - i;
  if (rest == 0) return;
  constexpr std::size_t kMaxLanes = kGroupBytes / sizeof(T);
  const T pad[3] = {};
  HWY_ALIGN float times[kMaxLanes] = {};
  HWY_ALIGN T moved[3 * kMaxLanes];
  std::memcpy(times, seconds + i, rest * sizeof(float));
  load_padded(d, points, i, rest, pad, x, y, z);
  move_packet(d, motion, load_seconds(d, times), x, y, z);
  hn::StoreInterleaved3(x, y, z, d, moved);
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
