// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The maximum projections of the lanes of blocks, and the support points among the points behind lanes with
// large projections.

// Included once per target by Highway's foreach_target.h.
#if defined(PCL_BV_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_BV_LANES_INL_H_
#undef PCL_BV_LANES_INL_H_
#else
#define PCL_BV_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include <bit>
#include <cstdint>
#include <optional>

#include "load-inl.h"
#include "support_plan.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

/// Packets per block. Fewer cost more stores; more leave more points to compare behind a lane. 26-DOP on
/// AVX-512: 4010 points take 3.1 us with 32 and 4.2 us with 64, 300 k points 100 and 97 us.
inline constexpr std::size_t kPackets = 32;

/// Few points are cut into about eight blocks. 26-DOP on AVX-512: 1000 points take 3.0 us, in two blocks 4.5
/// us; 300 points 2.4 us, in one block 3.0 us.
inline std::size_t packets_per_block(std::size_t packets) {
  return HWY_MIN(HWY_MAX(packets / 8, std::size_t{4}), kPackets);
}

/// Where the maximum projections are stored: per block support after support, for each support one number per
/// lane.
template <typename T>
struct LaneProjections {
  LaneProjections(T* first, std::size_t ends, std::size_t packets = kPackets)
      : values(first), lanes(hn::Lanes(Tag<T>())), block_points(packets * lanes), per_block(ends * lanes) {}

  T* values;
  std::size_t lanes;
  std::size_t block_points;
  std::size_t per_block;
};

template <typename T>
double max_over_lanes(const LaneProjections<T>& reach, std::size_t end, std::size_t points) {
  const Tag<T> d;
  const T* lanes = reach.values + end * reach.lanes;
  auto greatest = hn::Load(d, lanes);
  for (std::size_t begin = reach.block_points; begin < points; begin += reach.block_points)
    greatest = hn::Max(greatest, hn::Load(d, lanes += reach.per_block));
  return hn::GetLane(hn::MaxOfLanes(d, greatest));
}

/// Calls look(first, n, last) for the points first, first + n, ... below `last` behind each lane of a block
/// whose maximum projection is at least the threshold, a value of type T.
template <Layout layout, typename T, typename Look>
void search_lanes(const PointView& points, const LaneProjections<T>& reach, std::size_t end, double threshold,
                  const Look& look) {
  const Tag<T> d;
  const std::size_t n = reach.lanes;
  const auto least = hn::Set(d, static_cast<T>(threshold));
  const T* lanes = reach.values + end * n;
  for (std::size_t begin = 0; begin < points.count; begin += reach.block_points, lanes += reach.per_block) {
    const auto candidates = hn::Not(hn::Lt(hn::Load(d, lanes), least));  // an overflowing sum may be NaN
    if (HWY_LIKELY(hn::AllFalse(d, candidates))) continue;
    const std::size_t count = HWY_MIN(reach.block_points, points.count - begin);
    const std::size_t whole = begin + count / n * n;
    std::uint64_t bits = bits_of_mask(d, candidates);
    for (; bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
      const std::size_t point = point_of_lane<layout>(lane, n);
      look(begin + point, n, whole);
      if (whole == begin + count) continue;
      // The last packet was loaded either in order or as the last n points, which may begin in an earlier
      // block: look at both.
      look(whole + lane, n, begin + count);
      if (begin + count >= n) look(begin + count - n + point, n, begin + count);
    }
  }
}

/// Updates the supports in `out` with the points of a part, given the maximum projections of its lanes. If
/// `later` is not null, it receives lower bounds of the supports found, for the parts that follow.
template <Layout layout, typename T>
void search_supports(const PointView& part, const SupportDirections& set, const LaneProjections<T>& reach,
                 const Spread& spread, const SupportBounds& reached, SupportBounds* later,
                 ChunkSupports& out) {
  std::optional<SupportPlan> plan;  // for both supports of a direction
  for (std::size_t end = 0; end < 2 * set.count; ++end) {
    if (end % 2 == 0) plan.emplace(set, end / 2, spread, part.scalar);
    const SupportCandidates what = plan->of(end % 2 != 0, max_over_lanes(reach, end, part.count), reached[end]);
    if (what.kind == SupportCandidates::Kind::none) continue;
    SupportPoint& best = out.ends[end];
    if (what.kind == SupportCandidates::Kind::every) {
      keep_larger_projection(set.support_direction(end), first_valid_point(part), best);
    } else {
      const ExactSupportSearch<T> look(part, set, end, {spread.center, what.threshold});
      if (what.threshold <= 0) {  // which every lane passes
        look(0, 1, part.count, best);
      } else {
        search_lanes<layout>(
            part, reach, end, what.threshold,
            [&](std::size_t first, std::size_t step, std::size_t last) { look(first, step, last, best); });
      }
    }
    if (later != nullptr && best.found)
      (*later)[end] = HWY_MAX((*later)[end], projection_lower_bound(set, end, best.point));
  }
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
