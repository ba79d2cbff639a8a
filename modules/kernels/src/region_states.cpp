// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/kernels/region_states.h"

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
namespace pcl_bv::detail {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

void region_states(const PointView& points, const RegionTests::Prepared& regions, std::uint8_t* states) {
  for_layout(points, [&]<Layout layout, typename T>() {
    const RegionTestsOf<T>& all = regions.of<T>();
    states_by<layout, T>(points, all, states,
                         [&](auto d, auto near, auto x, auto y, auto z, auto& inside, auto& unclear)
                             HWY_ATTR {
                               for (const RegionTest<T>& test : all.regions)
                                 test_region(d, test, near, x, y, z, inside, unclear);
                             });
  });
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_bv::detail {

void region_states(UsableIsa isa, const PointView& points, const RegionTests& regions, std::uint8_t* states) {
  static constexpr KernelTable kTable = PCL_BV_KERNEL_TABLE(region_states, &region_states_reference);
  require_in_memory(points);
  kTable[isa](points, regions.prepared(), states);
}

}  // namespace pcl_bv::detail
#endif  // HWY_ONCE
