// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The maximum projection of each lane of a block, and the search for support points in lanes with large
// projections. The points of a lane are those that load_packet() loads into this lane.

// Compiled once per target of Highway's foreach_target.h.
#if defined(PCL_BV_LANE_PROJECTIONS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_BV_LANE_PROJECTIONS_INL_H_
#undef PCL_BV_LANE_PROJECTIONS_INL_H_
#else
#define PCL_BV_LANE_PROJECTIONS_INL_H_
#endif

#include <hwy/highway.h>

#include <bit>
#include <cstdint>
#include <optional>

#include "load-inl.h"
#include "support_plan.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

/// Maximum number of packets per block. With smaller blocks, more maximum projections are stored. With larger
/// blocks, more points must be searched in each lane that may hold the maximum. A 26-DOP of 4010 points on
/// AVX-512 takes 3.1 us with 32 packets and 4.2 us with 64 packets. For 300 k points it takes 100 us with 32
/// packets and 97 us with 64 packets.
inline constexpr std::size_t kPackets = 32;

/// Returns the number of packets per block. A small number of points is cut into about eight blocks. With
/// eight blocks, a 26-DOP of 1000 points on AVX-512 takes 3.0 us, with two blocks 4.5 us. A 26-DOP of 300
/// points takes 2.4 us, with one block 3.0 us.
inline std::size_t packets_per_block(std::size_t packets) {
  return HWY_MIN(HWY_MAX(packets / 8, std::size_t{4}), kPackets);
}

/// The array in which the maximum projections are stored. Each block has per_block numbers, support after
/// support, and each support has one number per lane.
template <typename T>
struct LaneProjections {
  LaneProjections(T* first, std::size_t supports, std::size_t packets = kPackets)
      : values(first),
        lanes(hn::Lanes(Tag<T>())),
        block_points(packets * lanes),
        per_block(supports * lanes) {}

  T* values;
  std::size_t lanes;
  std::size_t block_points;
  std::size_t per_block;
};

template <typename T>
double max_over_lanes(const LaneProjections<T>& projections, std::size_t support, std::size_t points) {
  const Tag<T> d;
  const T* lanes = projections.values + support * projections.lanes;
  auto greatest = hn::Load(d, lanes);
  for (std::size_t begin = projections.block_points; begin < points; begin += projections.block_points)
    greatest = hn::Max(greatest, hn::Load(d, lanes += projections.per_block));
  return hn::GetLane(hn::MaxOfLanes(d, greatest));
}

/// Calls search(first, n, last) for each lane of a block whose maximum projection is at least the threshold.
/// The points of the lane are first, first + n, ... below `last`. The threshold must be a value of type T.
template <Layout layout, typename T, typename Search>
void search_lanes(const PointView& points, const LaneProjections<T>& projections, std::size_t support,
                  double threshold, const Search& search) {
  const Tag<T> d;
  const std::size_t n = projections.lanes;
  const auto least = hn::Set(d, static_cast<T>(threshold));
  const T* lanes = projections.values + support * n;
  for (std::size_t begin = 0; begin < points.count;
       begin += projections.block_points, lanes += projections.per_block) {
    const auto candidates = hn::Not(hn::Lt(hn::Load(d, lanes), least));  // an overflowing sum may be NaN
    if (HWY_LIKELY(hn::AllFalse(d, candidates))) continue;
    const std::size_t count = HWY_MIN(projections.block_points, points.count - begin);
    const std::size_t whole = begin + count / n * n;
    std::uint64_t bits = bits_of_mask(d, candidates);
    for (; bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
      const std::size_t point = point_of_lane<layout>(lane, n);
      search(begin + point, n, whole);
      if (whole == begin + count) continue;
      // An incomplete last packet was loaded either in order or as the last n points, which may begin in an
      // earlier block. Both possibilities are searched.
      search(whole + lane, n, begin + count);
      if (begin + count >= n) search(begin + count - n + point, n, begin + count);
    }
  }
}

/// Updates the supports in `out` with the points of a part. `projections` has the maximum projections of the
/// part's lanes. If `later` is not null, it receives lower bounds of the supports found, for the parts that
/// follow.
template <Layout layout, typename T>
void search_supports(const PointView& part, const SupportDirections& set,
                     const LaneProjections<T>& projections, const CenteredExtent& extent,
                     const SupportBounds& bounds, SupportBounds* later, ChunkSupports& out) {
  std::optional<SupportPlan> plan;  // for both supports of one direction
  for (std::size_t support = 0; support < 2 * set.count; ++support) {
    if (support % 2 == 0) plan.emplace(set, support / 2, extent, part.scalar);
    const SupportCandidates candidates =
        plan->of(support % 2 != 0, max_over_lanes(projections, support, part.count), bounds[support]);
    if (candidates.kind == SupportCandidates::Kind::none) continue;
    SupportPoint& best = out.supports[support];
    if (candidates.kind == SupportCandidates::Kind::every) {
      keep_larger_projection(set.support_direction(support), first_valid_point(part), best);
    } else {
      const ExactSupportSearch<T> search(part, set, support, {extent.center, candidates.threshold});
      if (candidates.threshold <= 0) {  // every lane passes this threshold
        search(0, 1, part.count, best);
      } else {
        search_lanes<layout>(
            part, projections, support, candidates.threshold,
            [&](std::size_t first, std::size_t step, std::size_t last) { search(first, step, last, best); });
      }
    }
    if (later != nullptr && best.found)
      (*later)[support] = HWY_MAX((*later)[support], projection_lower_bound(set, support, best.point));
  }
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv::detail
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
