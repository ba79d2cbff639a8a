// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Sums whose bits do not depend on the width of a register: each block is first laid out as groups in order,
// with the origin, which adds nothing, in the place of invalid points; then as many passes as it takes sum
// the same 8 lanes. Between the passes the block stays in the first-level cache.

#include "pcl_bv/kernels/moments.h"

#include "moments_reference.h"
#include "pcl_bv/kernels/chunks.h"
#include "preconditions.h"
#include "targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "moments.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "gather-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv {
namespace HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR

void chunk_moments(const PointView& chunk, const Coordinates& origin, Moments& out) {
  chunk_moments_reference(chunk, origin, out);
}

#else

constexpr std::size_t kLanes = 8;

#define PCL_BV_EACH_TERM(DO)                                                                               \
  DO(0, x)                                                                                                 \
  DO(1, y)                                                                                                 \
  DO(2, z)                                                                                                 \
  DO(3, hn::Mul(x, x)) DO(4, hn::Mul(x, y)) DO(5, hn::Mul(x, z)) DO(6, hn::Mul(y, y)) DO(7, hn::Mul(y, z)) \
      DO(8, hn::Mul(z, z))
#define PCL_BV_DECLARE(k, term) auto sum##k = hn::Zero(d);
#define PCL_BV_STEP(k, term) sum##k = hn::Add(sum##k, term);
#define PCL_BV_KEEP(k, term) \
  hn::Store(hn::Add(hn::Load(d, sums + k * kLanes + lane), sum##k), d, sums + k * kLanes + lane);

// Adds the sums over a block's groups to those of the chunk, 8 lanes for each of the 9 terms.
template <typename T>
void add_block(const T* groups, std::size_t points, const Coordinates& origin, double* sums) {
  constexpr std::size_t per_group = kGroupBytes / sizeof(T);
  const Tag<double> d;
  const auto origin_x = hn::Set(d, origin.x);
  const auto origin_y = hn::Set(d, origin.y);
  const auto origin_z = hn::Set(d, origin.z);
  const std::size_t group_count = (points + per_group - 1) / per_group;
  for (std::size_t lane = 0; lane < kLanes; lane += hn::Lanes(d)) {
    PCL_BV_EACH_TERM(PCL_BV_DECLARE)
    const T* group = groups + lane;
    for (std::size_t g = 0; g < group_count; ++g, group += 3 * per_group) {
      for (std::size_t first = 0; first < per_group; first += kLanes) {
        const auto x = hn::Sub(load_as_double(d, group + first), origin_x);
        const auto y = hn::Sub(load_as_double(d, group + per_group + first), origin_y);
        const auto z = hn::Sub(load_as_double(d, group + 2 * per_group + first), origin_z);
        PCL_BV_EACH_TERM(PCL_BV_STEP)
      }
    }
    PCL_BV_EACH_TERM(PCL_BV_KEEP)
  }
}

#undef PCL_BV_EACH_TERM
#undef PCL_BV_DECLARE
#undef PCL_BV_STEP
#undef PCL_BV_KEEP

template <Layout layout, typename T>
void moments_of_chunk(const PointView& chunk, const Coordinates& origin, Moments& out) {
  HWY_ALIGN T groups[3 * kBlockPoints];
  HWY_ALIGN double sums[9 * kLanes] = {};
  const T pad[3] = {static_cast<T>(origin.x), static_cast<T>(origin.y), static_cast<T>(origin.z)};
  out = Moments();
  for (std::size_t begin = 0; begin < chunk.count; begin += kBlockPoints) {
    const PointView block = chunk.slice(begin, HWY_MIN(kBlockPoints, chunk.count - begin));
    out.count += gather<layout, true>(block, pad, groups);
    add_block(groups, block.count, origin, sums);
  }
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    for (std::size_t k = 0; k < 3; ++k)
      out.sum[k] += sums[k * kLanes + lane];
    for (std::size_t k = 0; k < 6; ++k)
      out.product[k] += sums[(3 + k) * kLanes + lane];
  }
}

template <typename T>
void moments_of(const PointView& chunk, const Coordinates& origin, Moments& out) {
#define PCL_BV_CALL(layout) moments_of_chunk<layout, T>(chunk, origin, out)
  PCL_BV_FOR_LAYOUT(T, chunk, PCL_BV_CALL)
#undef PCL_BV_CALL
}

void chunk_moments(const PointView& chunk, const Coordinates& origin, Moments& out) {
  if (chunk.scalar == ScalarType::float64) return moments_of<double>(chunk, origin, out);
  moments_of<float>(chunk, origin, out);
}

#endif  // HWY_TARGET == HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_bv {

void chunk_moments(UsableIsa isa, const PointView& chunk, const Coordinates& origin, Moments& out) {
  static constexpr KernelTable<void(const PointView&, const Coordinates&, Moments&)> kTable =
      PCL_BV_KERNEL_TABLE(chunk_moments, &chunk_moments_reference);
  require_in_memory(chunk, kChunkPoints);
  require_origin(chunk, origin);
  kTable[isa](chunk, origin, out);
}

}  // namespace pcl_bv
#endif  // HWY_ONCE
