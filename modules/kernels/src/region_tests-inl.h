// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Tests a packet of points against a region, for the target being compiled.

// Compiled once per target of Highway's foreach_target.h.
#if defined(PCL_BV_REGION_TESTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_BV_REGION_TESTS_INL_H_
#undef PCL_BV_REGION_TESTS_INL_H_
#else
#define PCL_BV_REGION_TESTS_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>

#include "load-inl.h"
#include "region_tests.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv::detail {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

// Number of half-spaces that are tested before classify_planes() checks whether all points are already
// outside.
constexpr std::size_t kTestsPerCheck = 4;

template <class D, typename T = hn::TFromD<D>>
HWY_INLINE hn::Mask<D> lanes_in_box(D d, const T (&low)[3], const T (&high)[3], V<D> x, V<D> y, V<D> z) {
  const auto in_x = hn::And(hn::Ge(x, hn::Set(d, low[0])), hn::Le(x, hn::Set(d, high[0])));
  const auto in_y = hn::And(hn::Ge(y, hn::Set(d, low[1])), hn::Le(y, hn::Set(d, high[1])));
  const auto in_z = hn::And(hn::Ge(z, hn::Set(d, low[2])), hn::Le(z, hn::Set(d, high[2])));
  return hn::And(hn::And(in_x, in_y), in_z);
}

template <class D, typename T = hn::TFromD<D>>
HWY_INLINE V<D> along(D d, const T (&n)[3], V<D> x, V<D> y, V<D> z) {
  return hn::Add(hn::Add(hn::Mul(hn::Set(d, n[0]), x), hn::Mul(hn::Set(d, n[1]), y)),
                 hn::Mul(hn::Set(d, n[2]), z));
}

// The classify functions set `inside` and `outside` to the lanes that are inside and outside the region. The
// results of lanes that need no test are meaningless. The two masks are not in a struct, since SVE vectors
// cannot be members.
template <class D, typename T = hn::TFromD<D>>
HWY_INLINE void classify_squares(D d, const RegionTest<T>& test, V<D> squares, hn::Mask<D>& inside,
                                 hn::Mask<D>& outside) {
  inside = hn::Le(squares, hn::Set(d, test.square_inner));
  outside = hn::Gt(squares, hn::Set(d, test.square_outer));
}

template <class D, typename T = hn::TFromD<D>>
HWY_INLINE void classify_ball(D d, const RegionTest<T>& test, V<D> x, V<D> y, V<D> z, hn::Mask<D>& inside,
                              hn::Mask<D>& outside) {
  classify_squares(d, test, hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z)), inside, outside);
}

template <class D, typename T = hn::TFromD<D>>
HWY_INLINE V<D> square_beyond(D d, const SlabTest<T>& slab, V<D> projection) {
  const auto beyond = hn::Max(hn::Sub(projection, hn::Set(d, slab.core)), hn::Zero(d));
  const auto weighted = hn::Mul(beyond, hn::Set(d, slab.weight));
  return hn::Mul(weighted, weighted);
}

template <bool slabs_only, class D, typename T = hn::TFromD<D>>
HWY_INLINE void classify_body(D d, const RegionTest<T>& test, V<D> x, V<D> y, V<D> z, hn::Mask<D>& inside,
                              hn::Mask<D>& outside) {
  const auto& [a, b, c] = test.slabs;
  const auto along_a = hn::Abs(along(d, a.axis, x, y, z));
  const auto along_b = hn::Abs(along(d, b.axis, x, y, z));
  const auto along_c = hn::Abs(along(d, c.axis, x, y, z));
  const auto excess =
      hn::Max(hn::Max(hn::Sub(along_a, hn::Set(d, a.slab)), hn::Sub(along_b, hn::Set(d, b.slab))),
              hn::Sub(along_c, hn::Set(d, c.slab)));
  inside = hn::Le(excess, hn::Set(d, -test.error));
  outside = hn::Gt(excess, hn::Set(d, test.error));
  if constexpr (!slabs_only) {
    const auto squares = hn::Add(hn::Add(square_beyond(d, a, along_a), square_beyond(d, b, along_b)),
                                 square_beyond(d, c, along_c));
    hn::Mask<D> round_inside, round_outside;
    classify_squares(d, test, squares, round_inside, round_outside);
    inside = hn::And(inside, round_inside);
    outside = hn::Or(outside, round_outside);
  }
}

template <class D, typename T = hn::TFromD<D>>
HWY_INLINE void classify_planes(D d, const RegionTest<T>& test, hn::Mask<D> tested, V<D> x, V<D> y, V<D> z,
                                hn::Mask<D>& inside, hn::Mask<D>& outside) {
  const auto error_bound =
      hn::Mul(hn::Add(hn::Add(hn::Abs(x), hn::Abs(y)), hn::Abs(z)), hn::Set(d, test.slope));
  inside = tested;
  outside = hn::AndNot(tested, tested);
  for (std::size_t k = 0; k < test.planes.size();) {
    const std::size_t end = HWY_MIN(k + kTestsPerCheck, test.planes.size());
    for (; k < end; ++k) {
      const PlaneTest<T>& plane = test.planes[k];
      const auto projection = along(d, plane.normal, x, y, z);
      inside = hn::And(inside, hn::Le(hn::Add(projection, error_bound), hn::Set(d, plane.inner)));
      outside = hn::Or(outside, hn::Gt(hn::Sub(projection, error_bound), hn::Set(d, plane.outer)));
    }
    if (hn::AllFalse(d, hn::AndNot(outside, tested))) break;
  }
}

// Adds the result of one region for the `near` lanes. Lanes inside another region are tested as well, because
// the processor then does not wait for the result of that region. This takes 0.8 of the time if most packets
// are in several boxes (AVX-512).
template <class D, typename T = hn::TFromD<D>>
HWY_INLINE void test_region(D d, const RegionTest<T>& test, hn::Mask<D> near, V<D> x, V<D> y, V<D> z,
                            hn::Mask<D>& inside, hn::Mask<D>& unclear) {
  auto tested = near;
  if (test.shape == RegionShape::box || test.shape == RegionShape::planes || test.undecidable) {
    tested = hn::And(tested, lanes_in_box(d, test.low, test.high, x, y, z));
    if (test.shape == RegionShape::box) inside = hn::Or(inside, tested);
    if (test.undecidable) unclear = hn::Or(unclear, tested);
    if (test.shape == RegionShape::box || test.undecidable) return;
  }
  x = hn::Sub(x, hn::Set(d, test.head[0]));
  y = hn::Sub(y, hn::Set(d, test.head[1]));
  z = hn::Sub(z, hn::Set(d, test.head[2]));
  if (test.shape == RegionShape::slabs || test.shape == RegionShape::rounded) {
    tested = hn::And(hn::And(tested, hn::Le(hn::Abs(x), hn::Set(d, test.max_offset[0]))),
                     hn::And(hn::Le(hn::Abs(y), hn::Set(d, test.max_offset[1])),
                             hn::Le(hn::Abs(z), hn::Set(d, test.max_offset[2]))));
  }
  if (hn::AllFalse(d, tested)) return;
  x = hn::Sub(x, hn::Set(d, test.tail[0]));
  y = hn::Sub(y, hn::Set(d, test.tail[1]));
  z = hn::Sub(z, hn::Set(d, test.tail[2]));
  hn::Mask<D> in, out;
  if (test.shape == RegionShape::ball) {
    classify_ball(d, test, x, y, z, in, out);
  } else if (test.shape == RegionShape::slabs) {
    classify_body<true>(d, test, x, y, z, in, out);
  } else if (test.shape == RegionShape::rounded) {
    classify_body<false>(d, test, x, y, z, in, out);
  } else {
    classify_planes(d, test, tested, x, y, z, in, out);
  }
  inside = hn::Or(inside, hn::And(tested, in));
  unclear = hn::Or(unclear, hn::AndNot(hn::Or(in, out), tested));
}

template <Layout layout, class D>
HWY_INLINE void store_states(D d, hn::Mask<D> inside, hn::Mask<D> unclear, std::size_t count,
                             std::uint8_t* states) {
  using T = hn::TFromD<D>;
  const hn::RebindToUnsigned<D> du;
  const std::size_t lanes = hn::Lanes(d);
  HWY_ALIGN hn::TFromD<decltype(du)> codes[kGroupBytes / sizeof(T)];
  const auto clear = hn::IfThenElseZero(inside, hn::BitCast(d, hn::Set(du, 1)));
  hn::Store(
      hn::BitCast(du, hn::IfThenElse(hn::AndNot(inside, unclear), hn::BitCast(d, hn::Set(du, 2)), clear)), du,
      codes);
  if (count == lanes) {
    for (std::size_t lane = 0; lane < lanes; ++lane)
      states[point_of_lane<layout>(lane, lanes)] = static_cast<std::uint8_t>(codes[lane]);
  } else {
    for (std::size_t lane = 0; lane < count; ++lane)
      states[lane] = static_cast<std::uint8_t>(codes[lane]);
  }
}

/// Writes the states of the points. test_packet(d, near, x, y, z, inside, unclear) adds the results of the
/// regions for a packet.
template <Layout layout, typename T, typename TestPacket>
HWY_INLINE void states_by(const PointView& points, const RegionTestsOf<T>& all, std::uint8_t* states,
                          const TestPacket& test_packet) {
  const Tag<T> d;
  const std::size_t lanes = hn::Lanes(d);
  std::fill_n(states, points.count, std::uint8_t{0});  // outside
  for (std::size_t i = 0; i < points.count; i += lanes) {
    V<decltype(d)> x, y, z;
    load_packet_or_tail<layout>(d, points, i, x, y, z);
    const auto near = lanes_in_box(d, all.low, all.high, x, y, z);
    if (hn::AllFalse(d, near)) continue;
    auto inside = hn::AndNot(near, near), unclear = inside;
    test_packet(d, near, x, y, z, inside, unclear);
    if (hn::AllFalse(d, hn::Or(inside, unclear))) continue;
    store_states<layout>(d, inside, unclear, HWY_MIN(lanes, points.count - i), states + i);
  }
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv::detail
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
