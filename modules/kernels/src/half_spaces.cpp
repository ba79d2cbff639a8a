// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/kernels/half_spaces.h"

#include "preconditions.h"
#include "references.h"
#include "targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "half_spaces.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "load-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv::detail {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

// Returns the lanes whose points are inside all half-spaces or in the ball. Without half-spaces, returns the
// lanes whose points are in the ball.
template <typename T, class D>
HWY_INLINE hn::Mask<D> inside_lanes(D d, const HalfSpaces& inside, const T (*planes)[4], V<D> x, V<D> y,
                                    V<D> z) {
  constexpr std::size_t kTestsPerCheck = 4;
  const auto squared = hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
  const auto in_ball = hn::Lt(squared, hn::Set(d, static_cast<T>(inside.squared_ball)));
  if (hn::AllTrue(d, in_ball)) return in_ball;
  auto in = in_ball;
  if (inside.count > 0) in = hn::Eq(x, x);
  for (std::size_t k = 0; k < inside.count;) {
    const std::size_t end = HWY_MIN(k + kTestsPerCheck, inside.count);
    for (; k < end; ++k) {
      const auto projection =
          hn::Add(hn::Add(hn::Mul(hn::Set(d, planes[k][0]), x), hn::Mul(hn::Set(d, planes[k][1]), y)),
                  hn::Mul(hn::Set(d, planes[k][2]), z));
      in = hn::And(in, hn::Lt(projection, hn::Set(d, planes[k][3])));
    }
    if (hn::AllFalse(d, in)) break;
  }
  return hn::Or(in, in_ball);
}

template <Layout layout, typename T>
std::size_t list_of(const PointView& points, const HalfSpaces& inside, std::uint32_t* positions) {
  const Tag<T> d;
  T planes[kMaxHalfSpaces][4];
  for (std::size_t k = 0; k < inside.count; ++k) {
    const HalfSpace& h = inside.planes[k];
    const double numbers[4] = {h.x, h.y, h.z, h.limit};
    for (std::size_t c = 0; c < 4; ++c)
      planes[k][c] = static_cast<T>(numbers[c]);
  }
  const auto cx = hn::Set(d, static_cast<T>(inside.center.x));
  const auto cy = hn::Set(d, static_cast<T>(inside.center.y));
  const auto cz = hn::Set(d, static_cast<T>(inside.center.z));
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.count; i += hn::Lanes(d)) {
    V<decltype(d)> x, y, z;
    load_packet_or_tail<layout>(d, points, i, x, y, z);
    const auto in = inside_lanes<T>(d, inside, planes, hn::Sub(x, cx), hn::Sub(y, cy), hn::Sub(z, cz));
    if (HWY_LIKELY(hn::AllTrue(d, in))) continue;
    count = append_marked<layout>(d, bits_of_mask(d, hn::Not(in)), points, i, positions, count);
  }
  return count;
}

std::size_t list_outside(const PointView& points, const HalfSpaces& inside, std::uint32_t* positions) {
  return for_layout(
      points, [&]<Layout layout, typename T>() { return list_of<layout, T>(points, inside, positions); });
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_bv::detail {

std::size_t list_outside(UsableIsa isa, const PointView& points, const HalfSpaces& inside,
                         std::uint32_t* positions) {
  static constexpr KernelTable kTable = PCL_BV_KERNEL_TABLE(list_outside, &list_outside_reference);
  require_in_memory(points, kMaxPositions);
  require_at_most(kMaxHalfSpaces, inside.count, "half-spaces");
  return kTable[isa](points, inside, positions);
}

}  // namespace pcl_bv::detail
#endif  // HWY_ONCE
