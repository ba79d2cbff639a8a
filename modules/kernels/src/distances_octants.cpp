// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Finds the largest distance in each octant, for the smallest enclosing sphere. Float arithmetic rejects runs
// of points, as the mask of EXPANDSPHERE (Karlsson, Winberg and Larsson 2010, Figure 3) rejects groups of
// four points. Double arithmetic decides about the remaining points.

#include "pcl_bv/kernels/distances.h"
#include "preconditions.h"
#include "references.h"
#include "targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "distances_octants.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "distances-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv::detail {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

// Tests one packet of a run that was not rejected as a whole. Returns true if no point of the packet is
// beyond the limit in float. Returns false for double points.
template <class D>
HWY_INLINE bool rejects(D d, const FloatCenter& center, float limit, V<D> x, V<D> y, V<D> z) {
  if constexpr (sizeof(hn::TFromD<D>) == 4) {
    return hn::AllFalse(d, hn::Gt(distances_in_float(d, center, x, y, z), hn::Set(d, limit)));
  }
  return false;
}

// The largest squared distances so far in each octant and lane, while a block is scanned.
struct LaneOctants {
  static constexpr std::size_t lanes = kGroupBytes / sizeof(double);
  LaneOctants() {
    for (double& b : best)
      b = -1;
  }

  // `d2` is the squared distance, or -1 for points that are ignored.
  template <class D>
  HWY_INLINE void compete(D d, V<D> x, V<D> y, V<D> z, V<D> d2) {
    const auto none = hn::Set(d, -1.0), zero = hn::Zero(d);
    const auto right = hn::Gt(x, zero), back = hn::Gt(y, zero), up = hn::Gt(z, zero);
    const auto z0 = hn::IfThenElse(up, none, d2), z1 = hn::IfThenElse(up, d2, none);
    const auto y0z0 = hn::IfThenElse(back, none, z0), y1z0 = hn::IfThenElse(back, z0, none);
    const auto y0z1 = hn::IfThenElse(back, none, z1), y1z1 = hn::IfThenElse(back, z1, none);
    keep(d, 0, hn::IfThenElse(right, none, y0z0));
    keep(d, 1, hn::IfThenElse(right, y0z0, none));
    keep(d, 2, hn::IfThenElse(right, none, y1z0));
    keep(d, 3, hn::IfThenElse(right, y1z0, none));
    keep(d, 4, hn::IfThenElse(right, none, y0z1));
    keep(d, 5, hn::IfThenElse(right, y0z1, none));
    keep(d, 6, hn::IfThenElse(right, none, y1z1));
    keep(d, 7, hn::IfThenElse(right, y1z1, none));
  }

  template <class D>
  HWY_INLINE void keep(D d, std::size_t octant, V<D> d2) {
    double* const lane = best + octant * lanes;
    hn::Store(hn::Max(hn::Load(d, lane), d2), d, lane);
  }

  template <class D>
  void reduce(D d, std::array<double, 8>& max_squared) const {
    for (std::size_t o = 0; o < 8; ++o)
      max_squared[o] = hn::GetLane(hn::MaxOfLanes(d, hn::Load(d, best + o * lanes)));
  }

  HWY_ALIGN double best[8 * lanes];
};

// Updates the octants with the points of a run. Returns false if an invalid point may be among the maxima.
// Always returns true if `masked`.
template <Layout layout, typename T, bool masked, bool filtered>
bool octants_of_run(const PointView& points, Run run, const OctantScan& scan, const FloatRejection& in_float,
                    LaneOctants& octants) {
  const Tag<T> d;
  const Tag<double> dd;
  const auto none = hn::Set(dd, -1.0);
  const auto least = hn::Set(dd, scan.limit);
  const auto infinity = hn::Set(dd, std::numeric_limits<double>::infinity());
  bool all_valid = true;
  for (std::size_t i = run.begin; i < run.end; i += hn::Lanes(d)) {
    V<decltype(d)> x, y, z;
    load_packet_or_tail<layout>(d, points, i, x, y, z);
    if constexpr (filtered) {
      if (rejects(d, in_float.center, in_float.limit, x, y, z)) continue;
    }
#define PCL_BV_STEP(x, y, z)                                         \
  [[maybe_unused]] const auto counts = valid_lanes(dd, x, y, z);     \
  subtract<sizeof(T) == 8>(dd, scan.center, x, y, z);                \
  auto d2 = sum_of_squares(x, y, z);                                 \
  if constexpr (masked) d2 = hn::IfThenElse(counts, d2, none);       \
  const auto far = hn::Ge(d2, least);                                \
  if (!hn::AllFalse(dd, far)) {                                      \
    all_valid = all_valid && hn::AllFalse(dd, hn::Ge(d2, infinity)); \
    octants.compete(dd, x, y, z, hn::IfThenElse(far, d2, none));     \
  }
    PCL_BV_IN_DOUBLE(T, d, dd, x, y, z, PCL_BV_STEP);
#undef PCL_BV_STEP
  }
  return all_valid;
}

// If three of a block's first four runs are not rejected (as on the surface of a sphere), the remaining runs
// are unlikely to be rejected, and the filter is switched off.
constexpr std::size_t kProbedRuns = 4;
constexpr std::size_t kMaxUnrejectedRuns = 3;

// Scans a block. Returns false if an invalid point may be among the maxima. Always returns true if `masked`.
template <Layout layout, typename T, bool masked>
bool octants_of(const PointView& points, OctantScan& scan) {
  const Tag<T> d;
  const FloatRejection in_float(scan.center, scan.limit);
  const T infinity = std::numeric_limits<T>::infinity();
  LaneOctants octants;
  std::size_t probed = 0, unrejected = 0;
  float* bounds = scan.bounds;
  bool filtered = sizeof(T) == 4 && scan.filter == FloatFilter::reject;
  for (Run run = run_at(d, 0, points.count); run.begin < points.count;
       run = run_at(d, run.end, points.count), bounds += bounds == nullptr ? 0 : hn::Lanes(d)) {
    if constexpr (sizeof(T) == 4) {
      if (filtered) {
        const auto greatest = greatest_in_float<layout>(d, points, run, in_float.center);
        if (bounds != nullptr) hn::StoreU(greatest, d, bounds);
        ++probed;
        if (hn::AllFalse(d, hn::Gt(greatest, hn::Set(d, in_float.limit)))) continue;
        if (++unrejected == kMaxUnrejectedRuns && probed <= kProbedRuns) filtered = false;
        if (!octants_of_run<layout, T, masked, true>(points, run, scan, in_float, octants)) return false;
        continue;
      }
      if (bounds != nullptr) hn::StoreU(hn::Set(d, infinity), d, bounds);
    }
    if (!octants_of_run<layout, T, masked, false>(points, run, scan, in_float, octants)) return false;
  }
  if (!filtered) scan.filter = FloatFilter::off;
  octants.reduce(Tag<double>(), scan.max_squared);
  return true;
}

void scan_octants(const PointView& block, OctantScan& scan) {
  for_layout(block, [&]<Layout layout, typename T>() {
    if (!octants_of<layout, T, sizeof(T) == 8>(block, scan)) octants_of<layout, T, true>(block, scan);
  });
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_bv::detail {

void scan_octants(UsableIsa isa, const PointView& block, OctantScan& scan) {
  static constexpr KernelTable kTable = PCL_BV_KERNEL_TABLE(scan_octants, &scan_octants_reference);
  require_distances(block, scan.center, kBlockPoints);
  kTable[isa](block, scan);
}

}  // namespace pcl_bv::detail
#endif  // HWY_ONCE
