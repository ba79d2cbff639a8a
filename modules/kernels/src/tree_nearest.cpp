// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <bit>
#include <limits>

#include "nearest_kept.h"
#include "pcl_bv/kernels/packed_tree.h"
#include "references.h"
#include "targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tree_nearest.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "packed_tree-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

// A group's boxes that are still to be visited, and how far they are.
struct Opened {
  HWY_ALIGN float squares[kTreeWidth];
  std::uint32_t bits;
  std::size_t first;  // what box 0 holds
};

HWY_INLINE std::uint32_t bits_within(const float* squares, float limit) {
  const Floats d;
  std::uint32_t bits = 0;
  for (std::size_t k = 0; k < kTreeWidth; k += hn::Lanes(d))
    bits |= bits_of_lanes(d, hn::Le(hn::Load(d, squares + k), hn::Set(d, limit))) << k;
  return bits;
}

// Opens a group and takes the nearest of its boxes; kTreeWidth if none is near.
HWY_INLINE std::size_t open_group(const BoxLevels& boxes, const BoxProbe& probe, std::size_t level,
                                  std::size_t item, Opened& opened) {
  const Floats d;
  const BoxGroup& group = boxes.groups[boxes.first[level] + item];
  opened.first = item * kTreeWidth;
  auto least = hn::Inf(d);
  for (std::size_t k = 0; k < kTreeWidth; k += hn::Lanes(d)) {
    const auto square = nearest_squares(d, group, probe, k);
    hn::Store(square, d, opened.squares + k);
    least = hn::Min(least, square);
  }
  const float nearest = hn::GetLane(hn::MinOfLanes(d, least));
  const std::uint32_t there = (1U << HWY_MIN(boxes.below[level] - opened.first, kTreeWidth)) - 1;
  opened.bits = 0;
  if (!(nearest <= probe.outer)) return kTreeWidth;
  const auto k = static_cast<std::size_t>(std::countr_zero(bits_within(opened.squares, nearest) & there));
  opened.bits = there & ~(1U << k);
  return k;
}

// The nearest of those that are left; kTreeWidth if none is near.
HWY_INLINE std::size_t take_nearest(Opened& opened, float outer) {
  const std::uint32_t near = opened.bits == 0 ? 0 : opened.bits & bits_within(opened.squares, outer);
  std::size_t nearest = kTreeWidth;
  float least = std::numeric_limits<float>::infinity();
  for (std::uint32_t bits = near; bits != 0; bits &= bits - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(bits));
    nearest = opened.squares[k] <= least ? k : nearest;
    least = opened.squares[k] <= least ? opened.squares[k] : least;
  }
  opened.bits = near & ~(1U << nearest);
  return nearest;
}

template <typename T>
HWY_INLINE void offer_packet(const PointPacket<T>& packet, const std::int32_t* numbers,
                             const Coordinates& center, NearestKept& kept) {
  HWY_ALIGN double squares[kTreeWidth];
  for (std::uint32_t bits = near_points(packet, center, kept.limit(), squares); bits != 0; bits &= bits - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
    if (squares[lane] <= kept.limit()) kept.offer({numbers[lane], squares[lane]});
  }
}

template <typename T>
HWY_INLINE void offer_packet(const PointPacket<T>& packet, const std::int32_t* numbers,
                             const Coordinates& center, NearestOne& kept) {
  const Doubles d;
  HWY_ALIGN double squares[kTreeWidth];
  auto least = hn::Inf(d);
  for (std::size_t k = 0; k < kTreeWidth; k += hn::Lanes(d)) {
    const auto square = packet_squares(d, packet, center, k);
    hn::Store(square, d, squares + k);
    least = hn::IfThenElse(hn::Lt(square, least), square, least);  // Min of a NaN may be NaN
  }
  const double nearest = hn::GetLane(hn::MinOfLanes(d, least));
  if (!(nearest <= kept.limit())) return;
  for (std::size_t lane = 0; lane < kTreeWidth; ++lane) {
    if (squares[lane] == nearest) kept.offer({numbers[lane], nearest});
  }
}

// Depth first, the nearest box first.
template <typename T, typename Kept>
void nearest_of(const PackedTree& tree, const std::vector<PointPacket<T>>& packets, const Coordinates& center,
                Kept& kept) {
  const BoxLevels& boxes = tree.boxes;
  BoxProbe probe(boxes, center, kept.limit());
  Opened opened[BoxLevels::kMostLevels];
  const std::size_t top = boxes.levels - 1;
  std::size_t level = top, k = open_group(boxes, probe, level, 0, opened[level]);
  for (;;) {
    if (k == kTreeWidth) {
      if (level++ == top) return;
    } else if (const std::size_t item = opened[level].first + k; level == 0) {
      offer_packet(packets[item], tree.numbers.data() + item * kTreeWidth, center, kept);
      probe.narrow(kept.limit());
    } else {
      --level;
      k = open_group(boxes, probe, level, item, opened[level]);
      continue;
    }
    k = take_nearest(opened[level], probe.outer);
  }
}

template <typename Kept>
void nearest_to(const PackedTree& tree, const Coordinates& center, Kept& kept) {
  if (tree.scalar == ScalarType::float32) {
    nearest_of(tree, tree.floats, center, kept);
  } else {
    nearest_of(tree, tree.doubles, center, kept);
  }
}

void list_nearest(const PackedTree& tree, const Coordinates& center, NearestKept& kept) {
  nearest_to(tree, center, kept);
}

void find_nearest(const PackedTree& tree, const Coordinates& center, NearestOne& kept) {
  nearest_to(tree, center, kept);
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_bv {

void list_nearest(UsableIsa isa, const PackedTree& tree, const Coordinates& center, std::size_t most,
                  double limit, std::vector<Neighbor>& found) {
  static constexpr KernelTable kTable = PCL_BV_KERNEL_TABLE(list_nearest, &list_nearest_reference);
  NearestKept kept(most, limit, found);
  if (tree.count == 0 || most == 0) return;
  kTable[isa](tree, center, kept);
  kept.finish();
}

std::optional<Neighbor> find_nearest(UsableIsa isa, const PackedTree& tree, const Coordinates& center,
                                     double limit) {
  static constexpr KernelTable kTable = PCL_BV_KERNEL_TABLE(find_nearest, &find_nearest_reference);
  NearestOne kept(limit);
  if (tree.count != 0) kTable[isa](tree, center, kept);
  return kept.found();
}

}  // namespace pcl_bv
#endif  // HWY_ONCE
