// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Computes sums whose bits do not depend on the width of a register. Each block is first copied to groups in
// order. The origin, which adds 0 to the sums, replaces invalid points and fills the last group. Then 8 lanes
// are summed, in several passes if a register has fewer lanes. The block stays in the first-level cache
// between the passes.

#include "pcl_bv/kernels/moments.h"

#include <cmath>

#include "pcl_bv/points/point_source.h"
#include "preconditions.h"
#include "references.h"
#include "targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "moments.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "copy_to_groups-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv::detail {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

constexpr std::size_t kLanes = 8;

#define PCL_BV_EACH_TERM(DO) \
  DO(0, x)                   \
  DO(1, y)                   \
  DO(2, z)                   \
  DO(3, hn::Mul(x, x))       \
  DO(4, hn::Mul(x, y)) DO(5, hn::Mul(x, z)) DO(6, hn::Mul(y, y)) DO(7, hn::Mul(y, z)) DO(8, hn::Mul(z, z))
#define PCL_BV_DECLARE(k, term) auto sum##k = hn::Zero(d);
#define PCL_BV_STEP(k, term) sum##k = hn::Add(sum##k, term);
#define PCL_BV_KEEP(k, term) hn::Store(sum##k, d, sums + k * kLanes + lane);

// Returns the differences from the origin. They are scaled for double points only.
template <typename T, class D>
HWY_INLINE V<D> relative(D d, const T* from, V<D> origin, V<D> scale) {
  const auto q = hn::Sub(load_as_double(d, from), origin);
  return sizeof(T) == 8 ? hn::Mul(q, scale) : q;
}

// Sums each of the 9 terms over the groups of a block, in 8 lanes. If `store`, also stores the offsets.
template <bool store, typename T>
void sum_groups(const T* groups, std::size_t points, const Moments& about, double* sums,
                [[maybe_unused]] BlockOffsets* offsets) {
  constexpr std::size_t per_group = kGroupBytes / sizeof(T);
  const Tag<double> d;
  const auto scale = hn::Set(d, std::ldexp(1.0, about.exponent));
  const auto origin_x = hn::Set(d, about.origin.x);
  const auto origin_y = hn::Set(d, about.origin.y);
  const auto origin_z = hn::Set(d, about.origin.z);
  const std::size_t group_count = (points + per_group - 1) / per_group;
  for (std::size_t lane = 0; lane < kLanes; lane += hn::Lanes(d)) {
    PCL_BV_EACH_TERM(PCL_BV_DECLARE)
    const T* group = groups + lane;
    for (std::size_t g = 0; g < group_count; ++g, group += 3 * per_group) {
      for (std::size_t first = 0; first < per_group; first += kLanes) {
        const auto x = relative(d, group + first, origin_x, scale);
        const auto y = relative(d, group + per_group + first, origin_y, scale);
        const auto z = relative(d, group + 2 * per_group + first, origin_z, scale);
        PCL_BV_EACH_TERM(PCL_BV_STEP)
        if constexpr (store) {
          const std::size_t i = g * per_group + first + lane;
          hn::Store(x, d, offsets->x + i);
          hn::Store(y, d, offsets->y + i);
          hn::Store(z, d, offsets->z + i);
        }
      }
    }
    PCL_BV_EACH_TERM(PCL_BV_KEEP)
  }
}

#undef PCL_BV_EACH_TERM
#undef PCL_BV_DECLARE
#undef PCL_BV_STEP
#undef PCL_BV_KEEP

// Stores the offsets if they are requested and not scaled.
template <typename T>
void add_lanes(const T* groups, std::size_t points, Moments& out, BlockOffsets* offsets) {
  HWY_ALIGN double sums[9 * kLanes];
  if (offsets != nullptr && out.exponent == 0) {
    sum_groups<true>(groups, points, out, sums, offsets);
    offsets->count = (points + kLanes - 1) / kLanes * kLanes;
  } else {
    sum_groups<false>(groups, points, out, sums, nullptr);
  }
  for (std::size_t k = 0; k < 9; ++k) {
    double sum = 0;  // a register; sums in memory would wait for each store
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      sum += sums[k * kLanes + lane];
    (k < 3 ? out.sum[k] : out.product[k - 3]) = sum;
  }
}

template <Layout layout, typename T>
Moments moments_of(const PointView& block, BlockOffsets* offsets) {
  HWY_ALIGN T groups[3 * kBlockPoints];
  Moments out;
  std::size_t first = 0;
  if (offsets != nullptr) offsets->count = 0;
  while (first < block.count && !is_valid(load_point(block, first)))
    ++first;
  if (first == block.count) return out;
  out.origin = load_point(block, first);
  const T pad[3] = {static_cast<T>(out.origin.x), static_cast<T>(out.origin.y), static_cast<T>(out.origin.z)};
  out.count = copy_to_groups<layout, true>(block, pad, groups);
  sum_without_underflow(block.scalar, out,
                        [&](Moments& moments) { add_lanes(groups, block.count, moments, offsets); });
  return out;
}

Moments block_moments(const PointView& block, BlockOffsets* offsets) {
  return for_layout(block,
                    [&]<Layout layout, typename T>() { return moments_of<layout, T>(block, offsets); });
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_bv::detail {

namespace {

Moments moments_and_offsets(UsableIsa isa, const PointView& block, BlockOffsets* offsets) {
  static constexpr KernelTable kTable = PCL_BV_KERNEL_TABLE(block_moments, &block_moments_reference);
  require_in_memory(block, kBlockPoints);
  return kTable[isa](block, offsets);
}

}  // namespace

Moments block_moments(UsableIsa isa, const PointView& block) {
  return moments_and_offsets(isa, block, nullptr);
}

Moments block_moments(UsableIsa isa, const PointView& block, BlockOffsets& offsets) {
  return moments_and_offsets(isa, block, &offsets);
}

}  // namespace pcl_bv::detail
#endif  // HWY_ONCE
