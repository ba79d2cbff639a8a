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

HWY_INLINE void open_group(const BoxLevels& boxes, const BoxProbe& probe, std::size_t level, std::size_t item,
                           Opened& opened) {
  const Floats d;
  const BoxGroup& group = boxes.groups[boxes.first[level] + item];
  opened.first = item * kTreeWidth;
  std::uint32_t bits = 0;
  for (std::size_t k = 0; k < kTreeWidth; k += hn::Lanes(d)) {
    const auto square = nearest_squares(d, group, probe, k);
    hn::Store(square, d, opened.squares + k);
    bits |= bits_of_lanes(d, hn::Le(square, hn::Set(d, probe.outer))) << k;
  }
  opened.bits = bits & ((1U << HWY_MIN(boxes.below[level] - opened.first, kTreeWidth)) - 1);
}

// The nearest of them, or kTreeWidth; forgets those that are too far by now.
HWY_INLINE std::size_t take_nearest(Opened& opened, float outer) {
  std::size_t nearest = kTreeWidth;
  float least = outer;
  std::uint32_t near = 0;
  for (std::uint32_t bits = opened.bits; bits != 0; bits &= bits - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(bits));
    const float square = opened.squares[k];
    near |= square <= outer ? bits & -bits : 0;
    nearest = square <= least ? k : nearest;
    least = square <= least ? square : least;
  }
  opened.bits = near & ~(1U << nearest);
  return nearest;
}

template <typename T>
HWY_INLINE void offer_packet(const PackedTree& tree, const PointPacket<T>& packet, std::size_t number,
                             const Coordinates& center, NearestKept& kept, BoxProbe& probe) {
  HWY_ALIGN double squares[kTreeWidth];
  std::uint32_t bits = near_points(packet, center, kept.limit(), squares);
  if (bits == 0) return;
  const std::int32_t* const numbers = tree.numbers.data() + number * kTreeWidth;
  for (; bits != 0; bits &= bits - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
    if (squares[lane] <= kept.limit()) kept.offer({numbers[lane], squares[lane]});
  }
  probe.narrow(kept.limit());
}

// Depth first, the nearest box first.
template <typename T>
void nearest_of(const PackedTree& tree, const std::vector<PointPacket<T>>& packets, const Coordinates& center,
                NearestKept& kept) {
  const BoxLevels& boxes = tree.boxes;
  BoxProbe probe(boxes, center, kept.limit());
  Opened opened[BoxLevels::kMostLevels];
  const std::size_t top = boxes.levels - 1;
  std::size_t level = top;
  open_group(boxes, probe, level, 0, opened[level]);
  while (level <= top) {
    const std::size_t k = take_nearest(opened[level], probe.outer);
    if (k == kTreeWidth) {
      ++level;
    } else if (const std::size_t item = opened[level].first + k; level == 0) {
      offer_packet(tree, packets[item], item, center, kept, probe);
    } else {
      --level;
      open_group(boxes, probe, level, item, opened[level]);
    }
  }
}

void list_nearest(const PackedTree& tree, const Coordinates& center, NearestKept& kept) {
  if (tree.scalar == ScalarType::float32) {
    nearest_of(tree, tree.floats, center, kept);
  } else {
    nearest_of(tree, tree.doubles, center, kept);
  }
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

}  // namespace pcl_bv
#endif  // HWY_ONCE
