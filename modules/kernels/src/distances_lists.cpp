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

// The limits of a list, for the exact comparison and for the two that only reject.
struct ListLimits {
  ListLimits(const DistanceCenter& c, double limit)
      : center(c), least(limit), fused(limit - std::abs(limit) * 0x1p-48 - 0x1p-1000), in_float(c, limit) {}
  DistanceCenter center;
  double least;
  // A squared distance with fused operations differs from squared_distance() by at most 6 * 2^-53 of it, and by
  // less than 2^-1000 if squares underflow.
  double fused;
  FloatRejection in_float;
};

// Returns whether no point of a packet can have a squared_distance() of at least the limit. Three of four
// instructions of the loop over a surface are here, so it does not ask which points are valid.
template <typename T, bool filtered, class D>
HWY_INLINE bool all_near(D d, const ListLimits& limits, V<D> x, V<D> y, V<D> z) {
  if constexpr (filtered) {
    const auto squared = distances_in_float(d, limits.in_float.center, x, y, z);
    if (hn::AllFalse(d, hn::Gt(squared, hn::Set(d, limits.in_float.limit)))) return true;
  }
  const Tag<double> dd;
  const auto least = hn::Set(dd, limits.fused);
  auto far = hn::Gt(least, least);  // none
#define PCL_BV_STEP(x, y, z)                                \
  subtract<sizeof(T) == 8>(dd, limits.center, x, y, z);     \
  far = hn::Or(far, hn::Ge(fused_squares(x, y, z), least));
  PCL_BV_IN_DOUBLE(T, d, dd, x, y, z, PCL_BV_STEP);
#undef PCL_BV_STEP
  return hn::AllFalse(dd, far);
}

template <Layout layout, typename T, bool filtered>
std::size_t list_of_run(const PointView& points, Run run, const ListLimits& limits, std::uint32_t* positions) {
  const Tag<T> d;
  const Tag<double> dd;
  const auto least = hn::Set(dd, limits.least);
  std::size_t count = 0;
  for (std::size_t i = run.begin; i < run.end; i += hn::Lanes(d)) {
    V<decltype(d)> x, y, z;
    load_packet_or_tail<layout>(d, points, i, x, y, z);
    if (HWY_LIKELY((all_near<T, filtered>(d, limits, x, y, z)))) continue;
    bool far[kGroupBytes / sizeof(T)] = {};
    bool* next = far;
#define PCL_BV_STEP(x, y, z)                                                            \
  const auto counts = valid_lanes(dd, x, y, z);                                         \
  subtract<sizeof(T) == 8>(dd, limits.center, x, y, z);                                 \
  store_mask(dd, hn::And(counts, hn::Ge(sum_of_squares(x, y, z), least)), next);        \
  next += hn::Lanes(dd);
    PCL_BV_IN_DOUBLE(T, d, dd, x, y, z, PCL_BV_STEP);
#undef PCL_BV_STEP
    count = append_marked<layout>(d, far, points, i, positions, count);
  }
  return count;
}

template <Layout layout, typename T>
std::size_t list_of(const PointView& points, const DistanceCenter& center, double limit, FloatFilter filter,
                    std::uint32_t* positions) {
  const Tag<T> d;
  const ListLimits limits(center, limit);
  std::size_t count = 0;
  for (Run run = run_at(d, 0, points.count); run.begin < points.count;
       run = run_at(d, run.end, points.count)) {
    if constexpr (sizeof(T) == 4) {
      if (filter == FloatFilter::reject) {
        const auto greatest = greatest_in_float<layout>(d, points, run, limits.in_float.center);
        if (!hn::AllFalse(d, hn::Gt(greatest, hn::Set(d, limits.in_float.limit))))
          count += list_of_run<layout, T, true>(points, run, limits, positions + count);
        continue;
      }
    }
    count += list_of_run<layout, T, false>(points, run, limits, positions + count);
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
