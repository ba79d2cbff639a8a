// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// GETSQUAREDDISTANCES of the paper's EXPANDSPHERE (Figure 3), a block at a time: float arithmetic rejects,
// double arithmetic decides.

#include "pcl_bv/kernels/distances.h"

#include "preconditions.h"
#include "references.h"
#include "targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "distances.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "distances-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

// The greatest squared_distance() of a block. Infinite only if some point is not valid, unless `masked`.
template <Layout layout, typename T, bool masked>
double greatest_in_double(const PointView& points, const DistanceCenter& center) {
  const Tag<T> d;
  const Tag<double> dd;
  const auto none = hn::Set(dd, -1.0);
  auto greatest = none;
  for (std::size_t i = 0; i < points.count; i += hn::Lanes(d)) {
    V<decltype(d)> x, y, z;
    load_some<layout>(d, points, i, x, y, z);
#define PCL_BV_STEP(x, y, z)                                     \
  [[maybe_unused]] const auto counts = valid_lanes(dd, x, y, z); \
  subtract<sizeof(T) == 8>(dd, center, x, y, z);                 \
  auto d2 = sum_of_squares(x, y, z);                             \
  if constexpr (masked) d2 = hn::IfThenElse(counts, d2, none);   \
  greatest = max_or_keep(dd, d2, greatest);
    PCL_BV_IN_DOUBLE(T, d, dd, x, y, z, PCL_BV_STEP);
#undef PCL_BV_STEP
  }
  return hn::GetLane(hn::MaxOfLanes(dd, greatest));
}

template <Layout layout, typename T>
double distance_of_block(const PointView& block, const DistanceCenter& center, double limit,
                         FloatFilter filter) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  if constexpr (sizeof(T) == 4) {
    if (filter == FloatFilter::reject) {
      const Tag<T> d;
      const Run all{0, block.count};
      const FloatCenter float_center(center);
      auto lanes = greatest_in_float<layout>(d, block, all, float_center);
      if (!hn::AllTrue(d, hn::Lt(lanes, hn::Set(d, infinity))))
        lanes = greatest_in_float<layout, true>(d, block, all, float_center);
      const float greatest = hn::GetLane(hn::MaxOfLanes(d, lanes));
      if (greatest < 0) return -1;
      const double bound = FloatBound(center).from_float(greatest);
      if (bound < limit) return bound;
    }
    const double greatest = greatest_in_double<layout, T, false>(block, center);
    if (greatest < infinity) return greatest;
  }
  return greatest_in_double<layout, T, true>(block, center);
}

void block_distances(const PointView& points, const DistanceCenter& center, double limit, FloatFilter filter,
                     double* greatest) {
  for_layout(points, [&]<Layout layout, typename T>() {
    for (std::size_t b = 0; b < block_count(points.count); ++b)
      greatest[b] = distance_of_block<layout, T>(block_of(points, b), center, limit, filter);
  });
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_bv {

void block_distances(UsableIsa isa, const PointView& points, const DistanceCenter& center, double limit,
                     FloatFilter filter, double* greatest) {
  static constexpr KernelTable kTable = PCL_BV_KERNEL_TABLE(block_distances, &block_distances_reference);
  require_distances(points, center);
  kTable[isa](points, center, limit, filter, greatest);
}

}  // namespace pcl_bv
#endif  // HWY_ONCE
