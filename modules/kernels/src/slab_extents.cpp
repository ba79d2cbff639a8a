// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A block of points is first copied to groups; offsets are read where they are. The origin replaces invalid
// points and fills the last group. The origin changes no extent, since its projection is 0 and low <= 0 <=
// high. After the copy, the loads are the same for all layouts, and the block is in the first-level cache.

#include "pcl_bv/kernels/slab_extents.h"

#include "pcl_bv/points/point_source.h"
#include "preconditions.h"
#include "references.h"
#include "targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "slab_extents.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "copy_to_groups-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv::detail {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

#define PCL_BV_EACH_AXIS(DO) DO(0) DO(1) DO(2)
#define PCL_BV_DECLARE(k)                   \
  const auto x##k = hn::Set(d, axes[k][0]); \
  const auto y##k = hn::Set(d, axes[k][1]); \
  const auto z##k = hn::Set(d, axes[k][2]); \
  auto low##k = hn::Zero(d), high##k = hn::Zero(d);
#define PCL_BV_STEP(k)                                                                         \
  const auto s##k = hn::Add(hn::Add(hn::Mul(x##k, qx), hn::Mul(y##k, qy)), hn::Mul(z##k, qz)); \
  low##k = hn::Min(low##k, s##k);                                                              \
  high##k = hn::Max(high##k, s##k);
#define PCL_BV_KEEP(k)                                                                  \
  result.low[k] = HWY_MIN(result.low[k], hn::GetLane(hn::MinOfLanes(d, low##k)) + 0.0); \
  result.high[k] = HWY_MAX(result.high[k], hn::GetLane(hn::MaxOfLanes(d, high##k)) + 0.0);

void grow_over_offsets(const BlockOffsets& offsets, const std::array<Direction, 3>& axes,
                       SlabExtents& result) {
  const Tag<double> d;
  PCL_BV_EACH_AXIS(PCL_BV_DECLARE)
  for (std::size_t i = 0; i < offsets.count; i += hn::Lanes(d)) {
    const auto qx = hn::Load(d, offsets.x + i);
    const auto qy = hn::Load(d, offsets.y + i);
    const auto qz = hn::Load(d, offsets.z + i);
    PCL_BV_EACH_AXIS(PCL_BV_STEP)
  }
  PCL_BV_EACH_AXIS(PCL_BV_KEEP)
}

template <typename T>
void grow_over_groups(const T* groups, std::size_t points, const Coordinates& origin,
                      const std::array<Direction, 3>& axes, SlabExtents& result) {
  constexpr std::size_t per_group = kGroupBytes / sizeof(T);
  const Tag<double> d;
  const auto ox = hn::Set(d, origin.x), oy = hn::Set(d, origin.y), oz = hn::Set(d, origin.z);
  PCL_BV_EACH_AXIS(PCL_BV_DECLARE)
  const T* group = groups;
  for (std::size_t begin = 0; begin < points; begin += per_group, group += 3 * per_group) {
    for (std::size_t first = 0; first < per_group; first += hn::Lanes(d)) {
      const auto qx = hn::Sub(load_as_double(d, group + first), ox);
      const auto qy = hn::Sub(load_as_double(d, group + per_group + first), oy);
      const auto qz = hn::Sub(load_as_double(d, group + 2 * per_group + first), oz);
      PCL_BV_EACH_AXIS(PCL_BV_STEP)
    }
  }
  PCL_BV_EACH_AXIS(PCL_BV_KEEP)
}

#undef PCL_BV_EACH_AXIS
#undef PCL_BV_DECLARE
#undef PCL_BV_STEP
#undef PCL_BV_KEEP

template <Layout layout, typename T>
SlabExtents extents_of(const PointView& points, const Coordinates& origin,
                       const std::array<Direction, 3>& axes) {
  SlabExtents result;
  HWY_ALIGN T groups[3 * kBlockPoints];
  const T pad[3] = {static_cast<T>(origin.x), static_cast<T>(origin.y), static_cast<T>(origin.z)};
  for (std::size_t b = 0; b < block_count(points.count); ++b) {
    const PointView block = block_of(points, b);
    copy_to_groups<layout, true>(block, pad, groups);
    grow_over_groups(groups, block.count, origin, axes, result);
  }
  return result;
}

SlabExtents slab_extents(const PointView& points, const Coordinates& origin,
                         const std::array<Direction, 3>& axes) {
  return for_layout(points,
                    [&]<Layout layout, typename T>() { return extents_of<layout, T>(points, origin, axes); });
}

SlabExtents slab_extents_of_offsets(const BlockOffsets& offsets, const std::array<Direction, 3>& axes) {
  SlabExtents result;
  grow_over_offsets(offsets, axes, result);
  return result;
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_bv::detail {

SlabExtents slab_extents(UsableIsa isa, const PointView& points, const Coordinates& origin,
                         const std::array<Direction, 3>& axes) {
  static constexpr KernelTable kTable = PCL_BV_KERNEL_TABLE(slab_extents, &slab_extents_reference);
  require_in_memory(points);
  require_origin(points, origin);
  return kTable[isa](points, origin, axes);
}

SlabExtents slab_extents(UsableIsa isa, const BlockOffsets& offsets, const std::array<Direction, 3>& axes) {
  static constexpr KernelTable kTable =
      PCL_BV_KERNEL_TABLE(slab_extents_of_offsets, &slab_extents_of_offsets_reference);
  return kTable[isa](offsets, axes);
}

}  // namespace pcl_bv::detail
#endif  // HWY_ONCE
