// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/kernels/region_states.h"

#include <algorithm>

#include "preconditions.h"
#include "references.h"
#include "region_tests.h"
#include "targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "region_states.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "load-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

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

// Of the lanes that `inside` has, those that stay, and those that are neither inside nor `outside`.
template <class D, typename T = hn::TFromD<D>>
HWY_INLINE void test_body(D d, const RegionTest<T>& test, V<D> x, V<D> y, V<D> z, hn::Mask<D>& inside,
                          hn::Mask<D>& outside) {
  const auto zero = hn::Zero(d);
  auto squares = zero;
  for (const SlabTest<T>& slab : test.slabs) {
    const auto reach = hn::Abs(along(d, slab.axis, x, y, z));
    inside = hn::And(inside, hn::Le(reach, hn::Set(d, slab.inner)));
    outside = hn::Or(outside, hn::Gt(reach, hn::Set(d, slab.outer)));
    const auto beyond = hn::Sub(reach, hn::Set(d, slab.core));
    const auto part = hn::Mul(hn::IfThenElseZero(hn::Gt(beyond, zero), beyond), hn::Set(d, slab.weight));
    squares = hn::Add(squares, hn::Mul(part, part));
  }
  inside = hn::And(inside, hn::Le(squares, hn::Set(d, test.square_inner)));
  outside = hn::Or(outside, hn::Gt(squares, hn::Set(d, test.square_outer)));
}

template <class D, typename T = hn::TFromD<D>>
HWY_INLINE void test_planes(D d, const RegionTest<T>& test, hn::Mask<D> asked, V<D> x, V<D> y, V<D> z,
                            hn::Mask<D>& inside, hn::Mask<D>& outside) {
  constexpr std::size_t kBetweenLooks = 4;
  const auto doubt = hn::Mul(hn::Add(hn::Add(hn::Abs(x), hn::Abs(y)), hn::Abs(z)), hn::Set(d, test.slope));
  for (std::size_t k = 0; k < test.planes.size();) {
    const std::size_t end = HWY_MIN(k + kBetweenLooks, test.planes.size());
    for (; k < end; ++k) {
      const PlaneTest<T>& plane = test.planes[k];
      const auto reach = along(d, plane.normal, x, y, z);
      inside = hn::And(inside, hn::Le(hn::Add(reach, doubt), hn::Set(d, plane.inner)));
      outside = hn::Or(outside, hn::Gt(hn::Sub(reach, doubt), hn::Set(d, plane.outer)));
    }
    if (hn::AllFalse(d, hn::AndNot(outside, asked))) return;
  }
}

// Adds what one region says of the lanes in its box.
template <class D, typename T = hn::TFromD<D>>
HWY_INLINE void test_region(D d, const RegionTest<T>& test, V<D> x, V<D> y, V<D> z, hn::Mask<D>& inside,
                            hn::Mask<D>& unclear) {
  const auto asked = hn::AndNot(inside, lanes_in_box(d, test.low, test.high, x, y, z));
  if (hn::AllFalse(d, asked)) return;
  if (test.shape == RegionShape::box) {
    inside = hn::Or(inside, asked);
    return;
  }
  const auto qx = hn::Sub(hn::Sub(x, hn::Set(d, test.head[0])), hn::Set(d, test.tail[0]));
  const auto qy = hn::Sub(hn::Sub(y, hn::Set(d, test.head[1])), hn::Set(d, test.tail[1]));
  const auto qz = hn::Sub(hn::Sub(z, hn::Set(d, test.head[2])), hn::Set(d, test.tail[2]));
  auto in = asked, out = hn::AndNot(asked, asked);
  if (test.shape == RegionShape::body) {
    test_body(d, test, qx, qy, qz, in, out);
  } else {
    test_planes(d, test, asked, qx, qy, qz, in, out);
  }
  inside = hn::Or(inside, in);
  unclear = hn::Or(unclear, hn::AndNot(hn::Or(in, out), asked));
}

template <Layout layout, class D>
HWY_INLINE void store_states(D d, hn::Mask<D> inside, hn::Mask<D> unclear, std::size_t count,
                             std::uint8_t* states) {
  const std::size_t lanes = hn::Lanes(d);
  bool in[kGroupBytes / sizeof(hn::TFromD<D>)], either[kGroupBytes / sizeof(hn::TFromD<D>)];
  store_mask(d, inside, in);
  store_mask(d, hn::AndNot(inside, unclear), either);
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const std::size_t point = count == lanes ? point_of_lane<layout>(lane, lanes) : lane;
    if (point < count) states[point] = static_cast<std::uint8_t>(in[lane] + 2 * either[lane]);
  }
}

template <Layout layout, typename T>
void states_of(const PointView& points, const RegionTestsOf<T>& all, std::uint8_t* states) {
  const Tag<T> d;
  const std::size_t lanes = hn::Lanes(d);
  std::fill_n(states, points.count, std::uint8_t{0});  // outside
  for (std::size_t i = 0; i < points.count; i += lanes) {
    V<decltype(d)> x, y, z;
    load_some<layout>(d, points, i, x, y, z);
    const auto near = lanes_in_box(d, all.low, all.high, x, y, z);
    if (hn::AllFalse(d, near)) continue;
    auto inside = hn::AndNot(near, near), unclear = inside;
    for (const RegionTest<T>& test : all.regions)
      test_region(d, test, x, y, z, inside, unclear);
    if (hn::AllFalse(d, hn::Or(inside, unclear))) continue;
    store_states<layout>(d, inside, unclear, HWY_MIN(lanes, points.count - i), states + i);
  }
}

void region_states(const PointView& points, const RegionTests::Prepared& regions, std::uint8_t* states) {
  for_layout(points,
             [&]<Layout layout, typename T>() { states_of<layout, T>(points, regions.of<T>(), states); });
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_bv {

void region_states(UsableIsa isa, const PointView& points, const RegionTests& regions, std::uint8_t* states) {
  static constexpr KernelTable kTable = PCL_BV_KERNEL_TABLE(region_states, &region_states_reference);
  require_in_memory(points);
  kTable[isa](points, regions.prepared(), states);
}

}  // namespace pcl_bv
#endif  // HWY_ONCE
