// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// FIND-k-DOP (Karlsson, Winberg and Larsson 2010, Figure 2) for the directions of a DirectionSet, which need
// no multiplications.

#include "pcl_bv/kernels/support.h"
#include "pcl_bv/points/point_source.h"
#include "references.h"
#include "support_plan.h"
#include "targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kdop_supports.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "lane_projections-inl.h"
#include "projection_extremes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv::detail {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

// Returns the index, in the set, of a direction of kCubeDirections; -1 if the set does not have it.
constexpr int slot(DirectionSet set, std::size_t direction) {
  for (std::size_t k = 0; k < direction_count(set); ++k) {
    if (cube_direction(set, k) == direction) return static_cast<int>(k);
  }
  return -1;
}

// x + y and x - y are computed once per packet, and six of the 13 projections use them. The macros use named
// variables instead of arrays, because the compiler does not know the size of SVE vectors.
// clang-format off
#define PCL_BV_EACH_DIRECTION(DO)                                                                 \
  DO(0, x) DO(1, y) DO(2, z)                                                                      \
  DO(3, hn::Add(sum, z)) DO(4, hn::Sub(sum, z)) DO(5, hn::Add(difference, z)) DO(6, hn::Sub(difference, z)) \
  DO(7, sum) DO(8, difference)                                                                    \
  DO(9, hn::Add(x, z)) DO(10, hn::Sub(x, z)) DO(11, hn::Add(y, z)) DO(12, hn::Sub(y, z))
// clang-format on

#define PCL_BV_DECLARE(i, projection)             \
  [[maybe_unused]] auto low##i = zero_minimum(d); \
  [[maybe_unused]] auto high##i = zero_maximum(d);

#define PCL_BV_STEP(i, projection)           \
  if constexpr (slot(set, i) >= 0) {         \
    const V<D> p = projection;               \
    low##i = update_minimum(d, low##i, p);   \
    high##i = update_maximum(d, high##i, p); \
  }

#define PCL_BV_STORE(i, projection)                                                         \
  if constexpr (slot(set, i) >= 0) {                                                        \
    hn::Store(minimum_magnitude(d, low##i), d, projections + 2 * slot(set, i) * n);         \
    hn::Store(maximum_projection(d, high##i), d, projections + (2 * slot(set, i) + 1) * n); \
  }

// Computes the maximum projection of each lane of a block for each support. Writes Lanes(d) numbers per
// support, support after support. Returns whether all points are valid; if not, `projections` is meaningless.
// If `masked`, invalid points are replaced by the centre, whose projection is 0, and counted in `dropped`;
// the result is then always true.
template <Layout layout, DirectionSet set, bool masked, class D, typename T = hn::TFromD<D>>
bool project_lanes(D d, const PointView& block, const T* center, T* projections, std::size_t& dropped) {
  const std::size_t n = hn::Lanes(d);
  PCL_BV_EACH_DIRECTION(PCL_BV_DECLARE)
  [[maybe_unused]] auto total = hn::Zero(d);
  std::size_t valid_count = 0;
  for (std::size_t i = 0; i < block.count; i += n) {
    V<D> x, y, z;
    prefetch_ahead<layout>(d, block, i);
    load_relative<layout, masked>(d, block, i, center, x, y, z, valid_count);
    const auto sum = hn::Add(x, y);
    [[maybe_unused]] const auto difference = hn::Sub(x, y);
    if constexpr (!masked && sizeof(T) == 8) total = hn::Add(total, hn::Add(sum, z));
    PCL_BV_EACH_DIRECTION(PCL_BV_STEP)
  }
  PCL_BV_EACH_DIRECTION(PCL_BV_STORE)
  if constexpr (masked) {
    dropped = (block.count + n - 1) / n * n - valid_count;
    return true;
  }
  dropped = 0;
  const T distance = valid_distance<T>(center);
  return all_within(d, distance, low0, high0) && all_within(d, distance, low1, high1) &&
         all_within(d, distance, low2, high2) && sum_is_finite(d, total);
}

// Projects all blocks of a chunk. Returns the number of dropped points.
template <Layout layout, DirectionSet set, typename T>
std::size_t project_blocks(const PointView& chunk, const T* center, const LaneProjections<T>& projections) {
  const Tag<T> d;
  std::size_t dropped = 0;
  bool clean = true;  // false after a block with an invalid point, because the next block often has one, too
  T* out = projections.values;
  for (std::size_t begin = 0; begin < chunk.count;
       begin += projections.block_points, out += projections.per_block) {
    const PointView block = chunk.slice(begin, HWY_MIN(projections.block_points, chunk.count - begin));
    std::size_t bad = 0;
    if (!clean || !project_lanes<layout, set, false>(d, block, center, out, bad)) {
      project_lanes<layout, set, true>(d, block, center, out, bad);
      clean = bad == 0;
    }
    dropped += bad;
  }
  return dropped;
}

template <Layout layout, DirectionSet set, typename T>
void supports_of_chunk(const PointView& chunk, const SupportBounds& bounds, ChunkSupports& out) {
  CenteredExtent extent;
  if (!central_point(chunk, extent.center)) {
    out.dropped = chunk.count;
    return;
  }
  const T c[3] = {static_cast<T>(extent.center.x), static_cast<T>(extent.center.y),
                  static_cast<T>(extent.center.z)};
  constexpr std::size_t supports = 2 * direction_count(set);
  // For a 26-DOP the array takes 104 KiB for floats and 208 KiB for doubles, for every width of vectors.
  HWY_ALIGN T values[kChunkPoints / kPackets * supports];
  const LaneProjections<T> projections(values, supports,
                                       packets_per_block(chunk.count / hn::Lanes(Tag<T>())));
  out.dropped = project_blocks<layout, set>(chunk, c, projections);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    extent.max_magnitude[axis] = HWY_MAX(max_over_lanes(projections, 2 * axis, chunk.count),
                                         max_over_lanes(projections, 2 * axis + 1, chunk.count));
  }
  search_supports<layout>(chunk, SupportDirections::of(set), projections, extent, bounds, nullptr, out);
}

template <DirectionSet set>
void supports_of(const PointView& chunk, const SupportBounds& bounds, ChunkSupports& out) {
  for_layout(chunk,
             [&]<Layout layout, typename T>() { supports_of_chunk<layout, set, T>(chunk, bounds, out); });
}

void cube_supports(const PointView& chunk, const SupportDirections& set, const SupportBounds& bounds,
                   ChunkSupports& out) {
  switch (*set.cube) {
    case DirectionSet::dop6:
      return supports_of<DirectionSet::dop6>(chunk, bounds, out);
    case DirectionSet::dop14:
      return supports_of<DirectionSet::dop14>(chunk, bounds, out);
    case DirectionSet::dop18:
      return supports_of<DirectionSet::dop18>(chunk, bounds, out);
    case DirectionSet::dop26:
      return supports_of<DirectionSet::dop26>(chunk, bounds, out);
  }
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_bv::detail {

void cube_supports(UsableIsa isa, const PointView& chunk, const SupportDirections& set,
                   const SupportBounds& bounds, ChunkSupports& out) {
  static constexpr KernelTable kTable = PCL_BV_KERNEL_TABLE(cube_supports, &chunk_supports_reference);
  kTable[isa](chunk, set, bounds, out);
}

}  // namespace pcl_bv::detail
#endif  // HWY_ONCE
