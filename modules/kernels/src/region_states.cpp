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

#include "region_tests-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

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
      test_region(d, test, near, x, y, z, inside, unclear);
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
