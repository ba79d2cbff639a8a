// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// FIND-k-DOP (Karlsson, Winberg and Larsson 2010, Figure 2) for directions that need multiplications. A block
// is loaded once and stays in the first-level cache while it is projected on groups of directions. A group
// has as many directions as there are registers for.

#include "pcl_bv/kernels/support.h"

#include "pcl_bv/points/point_source.h"
#include "references.h"
#include "support_plan.h"
#include "targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "support_general.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "lane_projections-inl.h"
#include "projection_extremes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv::detail {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

inline constexpr std::size_t kGroup = 4;  // number of directions on which a block is projected at a time

// The memory of supports_of(). `points` is a block of points relative to a centre, in packets of x, y and z.
// For floats, `points` takes 12 KiB and stays in the first-level cache. `projections` is for the maximum
// projections of the lanes. For floats and at most 13 directions, `projections` has capacity for a whole
// chunk. 49 directions on AVX-512 run at 320 Mpt/s with 25 KiB of projections, at 380 Mpt/s with 50 KiB and
// at 435 Mpt/s with 104 KiB.
template <typename T>
struct Workspace {
  HWY_ALIGN T points[3 * kBlockPoints];
  HWY_ALIGN T projections[104 * 1024 / sizeof(T)];
  T directions[3 * kMaxSupportDirections];
};

// Copies a block relative to the centre and raises `max_magnitude` to the largest magnitudes. Returns whether
// all points are valid; if not, the copy is meaningless and `max_magnitude` unchanged. If `masked`, invalid
// points are replaced by the centre and counted in `dropped`; the result is then always true.
template <Layout layout, bool masked, class D, typename T = hn::TFromD<D>>
bool copy_block(D d, const PointView& block, const T* center, T* points, std::array<double, 3>& max_magnitude,
                std::size_t& dropped) {
  const std::size_t n = hn::Lanes(d);
  auto max_x = zero_maximum(d), max_y = zero_maximum(d), max_z = zero_maximum(d);
  [[maybe_unused]] auto total = hn::Zero(d);
  std::size_t valid_count = 0;
  for (std::size_t i = 0; i < block.count; i += n, points += 3 * n) {
    V<D> x, y, z;
    load_relative<layout, masked>(d, block, i, center, x, y, z, valid_count);
    hn::Store(x, d, points);
    hn::Store(y, d, points + n);
    hn::Store(z, d, points + 2 * n);
    if constexpr (!masked && sizeof(T) == 8) total = hn::Add(total, hn::Add(hn::Add(x, y), z));
    max_x = update_maximum(d, max_x, hn::Abs(x));
    max_y = update_maximum(d, max_y, hn::Abs(y));
    max_z = update_maximum(d, max_z, hn::Abs(z));
  }
  dropped = masked ? (block.count + n - 1) / n * n - valid_count : 0;
  if constexpr (!masked) {
    const T distance = valid_distance<T>(center);
    const auto low = zero_minimum(d);
    if (!all_within(d, distance, low, max_x) || !all_within(d, distance, low, max_y) ||
        !all_within(d, distance, low, max_z) || !sum_is_finite(d, total)) {
      return false;
    }
  }
  const auto grow = [&](std::size_t axis, V<High<D>> maximum) {
    const double magnitude = hn::GetLane(hn::MaxOfLanes(d, maximum_projection(d, maximum)));
    max_magnitude[axis] = HWY_MAX(max_magnitude[axis], magnitude);
  };
  grow(0, max_x);
  grow(1, max_y);
  grow(2, max_z);
  return true;
}

// The macros use named variables instead of arrays, because the compiler does not know the size of SVE
// vectors.
#define PCL_BV_EACH_OF_GROUP(DO) DO(0) DO(1) DO(2) DO(3)

#define PCL_BV_DIRECTION(i)                                                               \
  [[maybe_unused]] const auto a##i = hn::Set(d, directions[3 * (i < count ? i : 0)]);     \
  [[maybe_unused]] const auto b##i = hn::Set(d, directions[3 * (i < count ? i : 0) + 1]); \
  [[maybe_unused]] const auto c##i = hn::Set(d, directions[3 * (i < count ? i : 0) + 2]);

#define PCL_BV_DECLARE(i)                         \
  [[maybe_unused]] auto low##i = zero_minimum(d); \
  [[maybe_unused]] auto high##i = zero_maximum(d);

// MulAdd may be fused or not. SupportPlan::pair_error_ covers both cases, and the remaining points are
// compared exactly.
#define PCL_BV_STEP(i)                                                         \
  if constexpr (i < count) {                                                   \
    const V<D> p = hn::MulAdd(c##i, z, hn::MulAdd(b##i, y, hn::Mul(a##i, x))); \
    low##i = update_minimum(d, low##i, p);                                     \
    high##i = update_maximum(d, high##i, p);                                   \
  }

#define PCL_BV_STORE(i)                                                     \
  if constexpr (i < count) {                                                \
    hn::Store(minimum_magnitude(d, low##i), d, values + 2 * i * n);         \
    hn::Store(maximum_projection(d, high##i), d, values + (2 * i + 1) * n); \
  }

// Computes the maximum projections of the lanes of copied packets for `count` directions. Stores them from
// `values` on.
template <std::size_t count, class D, typename T = hn::TFromD<D>>
HWY_INLINE void project_group(D d, const T* points, std::size_t packets, const T* directions,
                              std::size_t per_block, T* values) {
  const std::size_t n = hn::Lanes(d);
  PCL_BV_EACH_OF_GROUP(PCL_BV_DIRECTION)
  for (std::size_t begin = 0; begin < packets; begin += kPackets, values += per_block) {
    PCL_BV_EACH_OF_GROUP(PCL_BV_DECLARE)
    for (const T* end = points + HWY_MIN(kPackets, packets - begin) * 3 * n; points != end; points += 3 * n) {
      const auto x = hn::Load(d, points);
      const auto y = hn::Load(d, points + n);
      const auto z = hn::Load(d, points + 2 * n);
      PCL_BV_EACH_OF_GROUP(PCL_BV_STEP)
    }
    PCL_BV_EACH_OF_GROUP(PCL_BV_STORE)
  }
}

#undef PCL_BV_EACH_OF_GROUP
#undef PCL_BV_DIRECTION
#undef PCL_BV_DECLARE
#undef PCL_BV_STEP
#undef PCL_BV_STORE

template <class D, typename T = hn::TFromD<D>>
void project_copy(D d, const T* points, std::size_t packets, std::size_t count, const T* directions,
                  std::size_t per_block, T* values) {
  const std::size_t per_group = 2 * kGroup * hn::Lanes(d);
  for (; count >= kGroup; count -= kGroup, directions += 3 * kGroup, values += per_group)
    project_group<kGroup>(d, points, packets, directions, per_block, values);
  if (count == 3) project_group<3>(d, points, packets, directions, per_block, values);
  if (count == 2) project_group<2>(d, points, packets, directions, per_block, values);
  if (count == 1) project_group<1>(d, points, packets, directions, per_block, values);
}

// Projects the points of a part. Returns the number of dropped points.
template <Layout layout, typename T>
std::size_t project_part(const PointView& part, std::size_t count, const LaneProjections<T>& projections,
                         Workspace<T>& work, CenteredExtent& extent) {
  const Tag<T> d;
  const T center[3] = {static_cast<T>(extent.center.x), static_cast<T>(extent.center.y),
                       static_cast<T>(extent.center.z)};
  const std::size_t blocks = kBlockPoints / projections.block_points;  // copied at a time
  const std::size_t step = blocks * projections.block_points;
  std::size_t dropped = 0;
  bool clean = true;  // false after a block with an invalid point, because the next block often has one, too
  T* values = projections.values;
  for (std::size_t begin = 0; begin < part.count; begin += step, values += blocks * projections.per_block) {
    const PointView block = part.slice(begin, HWY_MIN(step, part.count - begin));
    std::size_t bad = 0;
    if (!clean || !copy_block<layout, false>(d, block, center, work.points, extent.max_magnitude, bad)) {
      copy_block<layout, true>(d, block, center, work.points, extent.max_magnitude, bad);
      clean = bad == 0;
    }
    dropped += bad;
    const std::size_t packets = (block.count + projections.lanes - 1) / projections.lanes;
    project_copy(d, work.points, packets, count, work.directions, projections.per_block, values);
  }
  return dropped;
}

// Finds the supports of a part, which has at most as many points as `projections` has capacity for. If `more`
// parts follow, `bounds` receives lower bounds of the supports found, so that later parts compare fewer
// points.
template <Layout layout, typename T>
void supports_of_part(const PointView& part, const SupportDirections& set,
                      const LaneProjections<T>& projections, bool more, Workspace<T>& work,
                      SupportBounds& bounds, ChunkSupports& out) {
  CenteredExtent extent;
  if (!central_point(part, extent.center)) {
    out.dropped += part.count;
    return;
  }
  out.dropped += project_part<layout>(part, set.count, projections, work, extent);
  search_supports<layout>(part, set, projections, extent, bounds, more ? &bounds : nullptr, out);
}

template <Layout layout, typename T>
void supports_of(const PointView& chunk, const SupportDirections& set, SupportBounds bounds,
                 ChunkSupports& out) {
  Workspace<T> work;
  for (std::size_t k = 0; k < set.count; ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      work.directions[3 * k + axis] = static_cast<T>(set.scaled[k][axis]);
  }
  const LaneProjections<T> projections(work.projections, 2 * set.count);
  const std::size_t per_copy = kBlockPoints / projections.block_points;
  const std::size_t copies = sizeof(work.projections) / sizeof(T) / projections.per_block / per_copy;
  const std::size_t part_points = copies * per_copy * projections.block_points;
  for (std::size_t begin = 0; begin < chunk.count; begin += part_points) {
    const PointView part = chunk.slice(begin, HWY_MIN(part_points, chunk.count - begin));
    supports_of_part<layout>(part, set, projections, begin + part_points < chunk.count, work, bounds, out);
  }
}

void general_supports(const PointView& chunk, const SupportDirections& set, const SupportBounds& bounds,
                      ChunkSupports& out) {
  for_layout(chunk, [&]<Layout layout, typename T>() { supports_of<layout, T>(chunk, set, bounds, out); });
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_bv::detail {

void general_supports(UsableIsa isa, const PointView& chunk, const SupportDirections& set,
                      const SupportBounds& bounds, ChunkSupports& out) {
  static constexpr KernelTable kTable = PCL_BV_KERNEL_TABLE(general_supports, &chunk_supports_reference);
  kTable[isa](chunk, set, bounds, out);
}

}  // namespace pcl_bv::detail
#endif  // HWY_ONCE
