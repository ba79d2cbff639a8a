// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/kernels/region_states.h"

#include "preconditions.h"
#include "references.h"
#include "region_tests.h"
#include "targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "region_subset_states.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "region_tests-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv::detail {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

void chosen_states(const PointView& points, const RegionTests::Prepared& regions, const ChosenRegions& chosen,
                   std::uint8_t* states) {
  for_layout(points, [&]<Layout layout, typename T>() {
    const RegionTestsOf<T>& all = regions.of<T>();
    states_by<layout, T>(
        points, all, states,
        [&](auto d, auto near, auto x, auto y, auto z, auto& inside, auto& unclear) HWY_ATTR {
          for (std::size_t k = 0; k < chosen.count;) {
            const std::size_t end = HWY_MIN(k + kTestsPerCheck, chosen.count);
            for (; k < end; ++k)
              test_region(d, all.regions[chosen.indices[k]], near, x, y, z, inside, unclear);
            if (hn::AllFalse(d, hn::AndNot(inside, near))) break;
          }
        });
  });
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_bv::detail {

void region_states(UsableIsa isa, const PointView& points, const RegionTests& regions,
                   const ChosenRegions& chosen, std::uint8_t* states) {
  static constexpr KernelTable kTable = PCL_BV_KERNEL_TABLE(chosen_states, &chosen_states_reference);
  require_in_memory(points);
  kTable[isa](points, regions.prepared(), chosen, states);
}

}  // namespace pcl_bv::detail
#endif  // HWY_ONCE
