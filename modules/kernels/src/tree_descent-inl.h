// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Walks through a tree depth first. In each group, the box with the smallest bound is visited first.

// Compiled once per target of Highway's foreach_target.h.
#if defined(PCL_BV_TREE_DESCENT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_BV_TREE_DESCENT_INL_H_
#undef PCL_BV_TREE_DESCENT_INL_H_
#else
#define PCL_BV_TREE_DESCENT_INL_H_
#endif

#include <bit>
#include <limits>

#include "packed_tree-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv::detail {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

// The boxes of a group that are still to be visited, and the bounds of all boxes of the group (see
// descend()).
struct OpenGroup {
  HWY_ALIGN float bounds[kTreeWidth];
  std::uint32_t bits;
  std::size_t first;  // item of box 0
};

HWY_INLINE std::uint32_t bits_within(const float* bounds, float limit) {
  const Floats d;
  std::uint32_t bits = 0;
  for (std::size_t k = 0; k < kTreeWidth; k += hn::Lanes(d))
    bits |= bits_of_lanes(d, hn::Le(hn::Load(d, bounds + k), hn::Set(d, limit))) << k;
  return bits;
}

// Opens a group. Returns the number of the box with the smallest bound and stores the other boxes in `open`.
// Returns kTreeWidth if no bound is at most `limit`.
template <typename Bound>
HWY_INLINE std::size_t open_group(const BoxLevels& boxes, const Bound& bound, float limit, std::size_t level,
                                  std::size_t item, OpenGroup& open) {
  const Floats d;
  const BoxGroup& group = boxes.groups[boxes.first[level] + item];
  open.first = item * kTreeWidth;
  auto least = hn::Inf(d);
  for (std::size_t k = 0; k < kTreeWidth; k += hn::Lanes(d)) {
    const auto bounds = bound(d, group, k);
    hn::Store(bounds, d, open.bounds + k);
    least = hn::Min(least, bounds);
  }
  const float nearest = hn::GetLane(hn::MinOfLanes(d, least));
  const std::uint32_t there = (1U << HWY_MIN(boxes.child_counts[level] - open.first, kTreeWidth)) - 1;
  open.bits = 0;
  if (!(nearest <= limit)) return kTreeWidth;
  const auto k = static_cast<std::size_t>(std::countr_zero(bits_within(open.bounds, nearest) & there));
  open.bits = there & ~(1U << k);
  return k;
}

// Removes the remaining box with the smallest bound and returns its number. Returns kTreeWidth if no
// remaining box has a bound of at most `limit`.
HWY_INLINE std::size_t take_nearest(OpenGroup& open, float limit) {
  const std::uint32_t near = open.bits == 0 ? 0 : open.bits & bits_within(open.bounds, limit);
  std::size_t nearest = kTreeWidth;
  float least = std::numeric_limits<float>::infinity();
  for (std::uint32_t bits = near; bits != 0; bits &= bits - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(bits));
    nearest = open.bounds[k] <= least ? k : nearest;
    least = open.bounds[k] <= least ? open.bounds[k] : least;
  }
  open.bits = near & ~(1U << nearest);
  return nearest;
}

/// Calls take(packet) for the packets whose boxes have a bound of at most `limit`, in the order of the walk.
/// take() may lower `limit`. bound(d, group, k) returns the bounds of the boxes k, k + 1, ... of a group. For
/// unused boxes, bound() must return infinity or the smallest bound of the used boxes.
template <typename Bound, typename Take>
HWY_INLINE void descend(const BoxLevels& boxes, const Bound& bound, const float& limit, const Take& take) {
  OpenGroup open[BoxLevels::kMaxLevels];
  const std::size_t top = boxes.levels - 1;
  std::size_t level = top, k = open_group(boxes, bound, limit, level, 0, open[level]);
  for (;;) {
    if (k == kTreeWidth) {
      if (level++ == top) return;
    } else if (const std::size_t item = open[level].first + k; level == 0) {
      take(item);
    } else {
      --level;
      k = open_group(boxes, bound, limit, level, item, open[level]);
      continue;
    }
    k = take_nearest(open[level], limit);
  }
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv::detail
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
