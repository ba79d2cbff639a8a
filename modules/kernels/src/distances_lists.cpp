// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Lists the points outside a sphere, for step UPDATESPHERE of EXPANDSPHERE (Karlsson, Winberg and Larsson
// 2010, Figure 3).

#include <cmath>

#include "distance_squared.h"
#include "pcl_bv/kernels/distances.h"
#include "preconditions.h"
#include "references.h"
#include "targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "distances_lists.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "distances-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv::detail {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

// Tests the kBoundPoints points of each lane whose bound exceeds the limit of the scan. Returns the number of
// listed points.
template <Layout layout>
std::size_t list_by_bounds(const PointView& block, const ScanBounds& scanned, const DistanceCenter& center,
                           double limit, std::uint32_t* positions) {
  const Tag<float> d;
  const std::size_t lanes = hn::Lanes(d);
  const float* bounds = scanned.bounds;
  const float least = float_limit(scanned.limit);
  std::size_t count = 0;
  for (std::size_t begin = 0; begin < block.count; begin += kBoundPoints * lanes, bounds += lanes) {
    if (hn::AllFalse(d, hn::Gt(hn::LoadU(d, bounds), hn::Set(d, least)))) continue;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      if (!(bounds[lane] > least)) continue;
      for (std::size_t packet = begin; packet < begin + kBoundPoints * lanes; packet += lanes) {
        // In an incomplete last packet, scan_octants() loaded the point `packet + lane` into this lane.
        const std::size_t i =
            packet + (packet + lanes <= block.count ? point_of_lane<layout>(lane, lanes) : lane);
        if (i >= block.count) break;
        positions[count] = static_cast<std::uint32_t>(i);
        count += distance_squared(load_as<float>(block, i), center) >= limit;
      }
    }
  }
  return count;
}

// Returns whether no point of a run can have a squared_distance() of at least `limit`, decided in double with
// fused operations. Returns false for a run that is not full. A fused distance differs from
// squared_distance() by at most 6 * 2^-53 of it, and by less than 2^-1000 if squares underflow. NaN is
// ignored.
template <Layout layout, typename T>
HWY_INLINE bool all_near_in_double(const PointView& points, Run run, const DistanceCenter& center,
                                   double limit) {
  const Tag<T> d;
  const Tag<double> dd;
  const std::size_t n = hn::Lanes(d);
  if (run.end - run.begin != kBoundPoints * n) return false;
  auto greatest = hn::Set(dd, -1.0), other = greatest;
  for (std::size_t i = run.begin; i < run.end; i += n) {
    prefetch_ahead<layout>(d, points, i);
    V<decltype(d)> x, y, z;
    load_packet<layout>(d, points, i, x, y, z);
#define PCL_BV_STEP(x, y, z)                                        \
  subtract<sizeof(T) == 8>(dd, center, x, y, z);                    \
  const auto next = max_or_keep(dd, fused_squares(x, y, z), other); \
  other = greatest;                                                 \
  greatest = next;
    PCL_BV_IN_DOUBLE(T, d, dd, x, y, z, PCL_BV_STEP);
#undef PCL_BV_STEP
  }
  const auto least = hn::Set(dd, limit - std::abs(limit) * 0x1p-48 - 0x1p-1000);
  return hn::AllFalse(dd, hn::Ge(hn::Max(greatest, other), least));
}

template <Layout layout, typename T, bool filtered>
std::size_t list_of_run(const PointView& points, Run run, const DistanceCenter& center, double limit,
                        const FloatRejection& in_float, std::uint32_t* positions) {
  const Tag<T> d;
  const Tag<double> dd;
  const auto least = hn::Set(dd, limit);
  std::size_t count = 0;
  for (std::size_t i = run.begin; i < run.end; i += hn::Lanes(d)) {
    V<decltype(d)> x, y, z;
    load_packet_or_tail<layout>(d, points, i, x, y, z);
    if constexpr (filtered) {
      const auto squared = distances_in_float(d, in_float.center, x, y, z);
      if (hn::AllFalse(d, hn::Gt(squared, hn::Set(d, in_float.limit)))) continue;
    }
    std::uint64_t far = 0;
    std::size_t lane = 0;
#define PCL_BV_STEP(x, y, z)                                                       \
  const auto px = x, py = y, pz = z;                                               \
  subtract<sizeof(T) == 8>(dd, center, x, y, z);                                   \
  const auto is_far = hn::Ge(sum_of_squares(x, y, z), least);                      \
  if (!hn::AllFalse(dd, is_far))                                                   \
    far |= bits_of_mask(dd, hn::And(is_far, valid_lanes(dd, px, py, pz))) << lane; \
  lane += hn::Lanes(dd);
    PCL_BV_IN_DOUBLE(T, d, dd, x, y, z, PCL_BV_STEP);
#undef PCL_BV_STEP
    if (far != 0) count = append_marked<layout>(d, far, points, i, positions, count);
  }
  return count;
}

template <Layout layout, typename T>
std::size_t list_of(const PointView& points, const DistanceCenter& center, double limit, FloatFilter filter,
                    std::uint32_t* positions) {
  const Tag<T> d;
  const FloatRejection in_float(center, limit);
  std::size_t count = 0;
  for (Run run = run_at(d, 0, points.count); run.begin < points.count;
       run = run_at(d, run.end, points.count)) {
    if constexpr (sizeof(T) == 4) {
      if (filter == FloatFilter::reject) {
        const auto greatest = greatest_in_float<layout>(d, points, run, in_float.center);
        if (!hn::AllFalse(d, hn::Gt(greatest, hn::Set(d, in_float.limit))))
          count += list_of_run<layout, T, true>(points, run, center, limit, in_float, positions + count);
        continue;
      }
    }
    if (!all_near_in_double<layout, T>(points, run, center, limit))
      count += list_of_run<layout, T, false>(points, run, center, limit, in_float, positions + count);
  }
  return count;
}

std::size_t list_distant_by_bounds(const PointView& block, const ScanBounds& scanned,
                                   const DistanceCenter& center, double limit, std::uint32_t* positions) {
  return for_layout(block, [&]<Layout layout, typename>() {
    return list_by_bounds<layout>(block, scanned, center, limit, positions);
  });
}

std::size_t list_distant(const PointView& points, const DistanceCenter& center, double limit,
                         FloatFilter filter, std::uint32_t* positions) {
  return for_layout(points, [&]<Layout layout, typename T>() {
    return list_of<layout, T>(points, center, limit, filter, positions);
  });
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_bv::detail {

std::size_t list_distant_by_bounds(UsableIsa isa, const PointView& block, const ScanBounds& scanned,
                                   const DistanceCenter& center, double limit, std::uint32_t* positions) {
  static constexpr KernelTable kTable =
      PCL_BV_KERNEL_TABLE(list_distant_by_bounds, &list_distant_by_bounds_reference);
  require_distances(block, center, kBlockPoints);
  require_scan_bounds(block, scanned);
  return kTable[isa](block, scanned, center, limit, positions);
}

std::size_t list_distant(UsableIsa isa, const PointView& points, const DistanceCenter& center, double limit,
                         FloatFilter filter, std::uint32_t* positions) {
  static constexpr KernelTable kTable = PCL_BV_KERNEL_TABLE(list_distant, &list_distant_reference);
  require_distances(points, center, kMaxPositions);
  return kTable[isa](points, center, limit, filter, positions);
}

}  // namespace pcl_bv::detail
#endif  // HWY_ONCE
