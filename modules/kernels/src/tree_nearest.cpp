// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <bit>

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

// What is still to be visited, the nearest last.
struct Pending {
  float square;
  std::uint32_t level;
  std::size_t item;
};

// Each level adds 16 at most, of which one is taken before the next level adds some.
using PendingStack = Pending[(BoxLevels::kMostLevels + 1) * kTreeWidth];

// Puts the near boxes of a group on top of the stack, the nearest last. Returns the new size.
HWY_INLINE std::size_t push_near(const BoxLevels& boxes, const BoxProbe& probe, std::uint32_t level,
                                 std::size_t group, PendingStack& stack, std::size_t size) {
  const Floats d;
  HWY_ALIGN float squares[kTreeWidth];
  const BoxGroup& sides = boxes.groups[boxes.first[level] + group];
  std::uint32_t bits = 0;
  for (std::size_t k = 0; k < kTreeWidth; k += hn::Lanes(d)) {
    const auto square = nearest_squares(d, sides, probe, k);
    hn::Store(square, d, squares + k);
    bits |= bits_of_lanes(d, hn::Le(square, hn::Set(d, probe.outer))) << k;
  }
  const std::size_t first = group * kTreeWidth;
  bits &= (1U << HWY_MIN(boxes.below[level] - first, kTreeWidth)) - 1;
  const std::size_t bottom = size;
  for (; bits != 0; bits &= bits - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(bits));
    std::size_t place = size++;
    for (; place > bottom && stack[place - 1].square < squares[k]; --place)
      stack[place] = stack[place - 1];
    stack[place] = {squares[k], level, first + k};
  }
  return size;
}

template <typename T>
void nearest_of(const PackedTree& tree, const std::vector<PointPacket<T>>& packets, const Coordinates& center,
                NearestKept& kept) {
  const BoxLevels& boxes = tree.boxes;
  BoxProbe probe(boxes, center, kept.limit());
  PendingStack stack;
  std::size_t size = 0;
  for (std::size_t group = 0; group < boxes.below[boxes.levels]; ++group)
    stack[size++] = {0, static_cast<std::uint32_t>(boxes.levels), group};
  HWY_ALIGN double squares[kTreeWidth];
  while (size > 0) {
    const Pending next = stack[--size];
    if (!(next.square <= probe.outer)) continue;
    if (next.level > 0) {
      size = push_near(boxes, probe, next.level - 1, next.item, stack, size);
      continue;
    }
    std::uint32_t bits = near_points(packets[next.item], center, kept.limit(), squares);
    if (bits == 0) continue;
    const std::int32_t* const numbers = tree.numbers.data() + next.item * kTreeWidth;
    for (; bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
      if (squares[lane] <= kept.limit()) kept.offer({numbers[lane], squares[lane]});
    }
    probe.narrow(kept.limit());
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
