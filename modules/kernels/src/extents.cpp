// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// FIND-k-DOP of the paper (Figure 2), once in the source, compiled for every instruction set.

#include "pcl_bv/kernels/extents.h"

#include <limits>

#include "extents_reference.h"
#include "targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "extents.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "load-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv {
namespace HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR

void block_extents(const PointView& points, DirectionSet set, BlockExtents* blocks) {
  block_extents_reference(points, set, blocks);
}

#else

// Position of a direction of kCubeDirections among those of a set, or -1.
constexpr int slot(DirectionSet set, std::size_t direction) {
  for (std::size_t k = 0; k < direction_count(set); ++k) {
    if (cube_direction(set, k) == direction) return static_cast<int>(k);
  }
  return -1;
}

// The 13 projections of a packet, with the sums x + y and x - y shared. Named variables, not arrays: vectors
// of SVE have no size that the compiler knows.
// clang-format off
#define PCL_BV_EACH_DIRECTION(DO)                                                                 \
  DO(0, x) DO(1, y) DO(2, z)                                                                      \
  DO(3, hn::Add(sum, z)) DO(4, hn::Sub(sum, z)) DO(5, hn::Add(difference, z)) DO(6, hn::Sub(difference, z)) \
  DO(7, sum) DO(8, difference)                                                                    \
  DO(9, hn::Add(x, z)) DO(10, hn::Sub(x, z)) DO(11, hn::Add(y, z)) DO(12, hn::Sub(y, z))
// clang-format on

#define PCL_BV_DECLARE(i, projection)                                            \
  [[maybe_unused]] auto low##i = hn::Set(d, std::numeric_limits<T>::infinity()); \
  [[maybe_unused]] auto high##i = hn::Set(d, -std::numeric_limits<T>::infinity());

#define PCL_BV_STEP(i, projection)   \
  if constexpr (slot(set, i) >= 0) { \
    const auto p = projection;       \
    low##i = hn::Min(low##i, p);     \
    high##i = hn::Max(high##i, p);   \
  }

// + 0.0: sets differ in the sign of a zero that min and max keep.
#define PCL_BV_STORE(i, projection)                                         \
  if constexpr (slot(set, i) >= 0) {                                        \
    out.low[slot(set, i)] = hn::GetLane(hn::MinOfLanes(d, low##i)) + 0.0;   \
    out.high[slot(set, i)] = hn::GetLane(hn::MaxOfLanes(d, high##i)) + 0.0; \
  }

// Extents of one block. Returns whether all its points are valid; if not, `out` means nothing. With `masked`,
// `pad` must be a valid point: it takes the place of the others, which are counted.
template <Layout layout, DirectionSet set, bool masked, class D, typename T = hn::TFromD<D>>
bool extents_of_block(D d, const PointView& points, const T* pad, BlockExtents& out) {
  const std::size_t n = hn::Lanes(d);
  [[maybe_unused]] const auto limit =
      hn::Set(d, sizeof(T) == 4 ? hwy::HighestValue<T>() : static_cast<T>(1e100));
  PCL_BV_EACH_DIRECTION(PCL_BV_DECLARE)
  auto total = hn::Zero(d);
  std::size_t dropped = 0;
  for (std::size_t i = 0; i < points.count; i += n) {
    hn::Vec<D> x, y, z;
    if (i + n <= points.count) {
      load_packet<layout>(d, points, i, x, y, z);
    } else {
      load_few(d, points, i, points.count - i, pad, x, y, z);
    }
    if constexpr (masked) {
      const auto valid =
          hn::And(hn::And(hn::Le(hn::Abs(x), limit), hn::Le(hn::Abs(y), limit)), hn::Le(hn::Abs(z), limit));
      dropped += n - hn::CountTrue(d, valid);
      x = hn::IfThenElse(valid, x, hn::Set(d, pad[0]));
      y = hn::IfThenElse(valid, y, hn::Set(d, pad[1]));
      z = hn::IfThenElse(valid, z, hn::Set(d, pad[2]));
    }
    const auto sum = hn::Add(x, y);
    [[maybe_unused]] const auto difference = hn::Sub(x, y);
    // One invalid coordinate makes the total NaN or infinite for good; an overflow of the total is a false
    // alarm.
    if constexpr (!masked) total = hn::Add(total, hn::Add(sum, z));
    PCL_BV_EACH_DIRECTION(PCL_BV_STEP)
  }
  PCL_BV_EACH_DIRECTION(PCL_BV_STORE)
  out.dropped = dropped;
  if constexpr (masked) return true;
  if (!hn::AllTrue(d, hn::Le(hn::Abs(total), hn::Set(d, hwy::HighestValue<T>())))) return false;
  if constexpr (sizeof(T) == 4) return true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (out.low[axis] < -1e100 || out.high[axis] > 1e100) return false;
  }
  return true;
}

template <typename T>
bool find_valid_point(const PointView& points, T* point) {
  for (std::size_t i = 0; i < points.count; ++i) {
    if (!is_valid(load_point(points, i))) continue;
    std::memcpy(point, points.address(i), 3 * sizeof(T));
    return true;
  }
  return false;
}

template <Layout layout, DirectionSet set, typename T>
void extents_of_blocks(const PointView& points, BlockExtents* blocks) {
  const hn::ScalableTag<T> d;
  for (std::size_t begin = 0; begin < points.count; begin += kBlockPoints) {
    const PointView block = points.slice(begin, HWY_MIN(kBlockPoints, points.count - begin));
    BlockExtents& out = *blocks++;
    T pad[3];
    std::memcpy(pad, block.address(0), sizeof pad);
    if (extents_of_block<layout, set, false>(d, block, pad, out)) continue;
    if (find_valid_point(block, pad)) {
      extents_of_block<layout, set, true>(d, block, pad, out);
    } else {
      out.low.fill(std::numeric_limits<double>::infinity());
      out.high.fill(-std::numeric_limits<double>::infinity());
      out.dropped = block.count;
    }
  }
}

template <Layout layout, typename T>
void extents_of_set(const PointView& points, DirectionSet set, BlockExtents* blocks) {
  switch (set) {
    case DirectionSet::dop6:
      return extents_of_blocks<layout, DirectionSet::dop6, T>(points, blocks);
    case DirectionSet::dop14:
      return extents_of_blocks<layout, DirectionSet::dop14, T>(points, blocks);
    case DirectionSet::dop18:
      return extents_of_blocks<layout, DirectionSet::dop18, T>(points, blocks);
    case DirectionSet::dop26:
      return extents_of_blocks<layout, DirectionSet::dop26, T>(points, blocks);
  }
}

void block_extents(const PointView& points, DirectionSet set, BlockExtents* blocks) {
  if (points.scalar == ScalarType::float64) return extents_of_set<Layout::any, double>(points, set, blocks);
  switch (layout_of(points)) {
    case Layout::packed12:
      return extents_of_set<Layout::packed12, float>(points, set, blocks);
    case Layout::packed16:
      return extents_of_set<Layout::packed16, float>(points, set, blocks);
    case Layout::wide:
      return extents_of_set<Layout::wide, float>(points, set, blocks);
    case Layout::any:
      return extents_of_set<Layout::any, float>(points, set, blocks);
  }
}

#endif  // HWY_TARGET == HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_bv {

void block_extents(Isa isa, const PointView& points, DirectionSet set, BlockExtents* blocks) {
  static constexpr KernelTable<void(const PointView&, DirectionSet, BlockExtents*)> kTable =
      PCL_BV_KERNEL_TABLE(block_extents, &block_extents_reference);
  kTable[isa](points, set, blocks);
}

}  // namespace pcl_bv
#endif  // HWY_ONCE
