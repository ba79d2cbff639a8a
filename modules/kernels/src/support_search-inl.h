// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Included once per target by Highway's foreach_target.h.
#if defined(PCL_BV_SUPPORT_SEARCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_BV_SUPPORT_SEARCH_INL_H_
#undef PCL_BV_SUPPORT_SEARCH_INL_H_
#else
#define PCL_BV_SUPPORT_SEARCH_INL_H_
#endif

#include <optional>

#include "lanes-inl.h"
#include "support_plan.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

/// Lets the supports in `out` compete with the points of a part, given what its lanes reach. What the
/// supports reach is noted in `later`, if it is not null, for parts that come later.
template <Layout layout, typename T>
void search_ends(const PointView& part, const SupportDirections& set, const LaneReach<T>& reach,
                 const Spread& spread, const ReachedSupports& reached, ReachedSupports* later,
                 ChunkSupports& out) {
  std::optional<SupportPlan> plan;  // for both ends of a direction
  for (std::size_t end = 0; end < 2 * set.count; ++end) {
    if (end % 2 == 0) plan.emplace(set, end / 2, spread, part.scalar);
    const EndSearch what = plan->of(end % 2 != 0, greatest_reach(reach, end, part.count), reached[end]);
    if (what.kind == EndSearch::Kind::none) continue;
    SupportPoint& best = out.ends[end];
    if (what.kind == EndSearch::Kind::every) {
      keep_farther(set.end_direction(end), first_valid_point(part), best);
    } else {
      const RoundedFilter filter{spread.center, what.threshold};
      search_lanes<layout>(part, reach, end, filter.threshold,
                           [&](std::size_t first, std::size_t step, std::size_t last) {
                             find_support(part, first, step, last, set, end, filter, best);
                           });
    }
    if (later != nullptr && best.found)
      (*later)[end] = HWY_MAX((*later)[end], surely_reached(set, end, best.point));
  }
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
