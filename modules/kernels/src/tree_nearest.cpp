// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <bit>

#include "nearest_set.h"
#include "pcl_bv/kernels/packed_tree.h"
#include "references.h"
#include "targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tree_nearest.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "tree_descent-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv::detail {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

template <typename T>
HWY_INLINE void offer_packet(const PointPacket<T>& packet, const std::int32_t* indices,
                             const Coordinates& center, NearestSet& kept) {
  HWY_ALIGN double squares[kTreeWidth];
  for (std::uint32_t bits = near_points(packet, center, kept.limit(), squares); bits != 0; bits &= bits - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
    if (squares[lane] <= kept.limit()) kept.offer({indices[lane], squares[lane]});
  }
}

template <typename T>
HWY_INLINE void offer_packet(const PointPacket<T>& packet, const std::int32_t* indices,
                             const Coordinates& center, NearestOne& kept) {
  const Doubles d;
  HWY_ALIGN double squares[kTreeWidth];
  auto least = hn::Inf(d);
  for (std::size_t k = 0; k < kTreeWidth; k += hn::Lanes(d)) {
    const auto square = packet_squares(d, packet, center, k);
    hn::Store(square, d, squares + k);
    least = hn::IfThenElse(hn::Lt(square, least), square, least);  // Min with a NaN may be NaN
  }
  const double nearest = hn::GetLane(hn::MinOfLanes(d, least));
  if (!(nearest <= kept.limit())) return;
  for (std::size_t lane = 0; lane < kTreeWidth; ++lane) {
    if (squares[lane] == nearest) kept.offer({indices[lane], nearest});
  }
}

template <typename T, typename Kept>
void nearest_of(const PackedTree& tree, const std::vector<PointPacket<T>>& packets, const Coordinates& center,
                Kept& kept) {
  BoxProbe probe(tree.boxes, center, kept.limit());
  descend(
      tree.boxes,
      [&](Floats d, const BoxGroup& group, std::size_t k) { return nearest_squares(d, group, probe, k); },
      probe.outer,
      [&](std::size_t packet) {
        offer_packet(packets[packet], tree.indices.data() + packet * kTreeWidth, center, kept);
        probe.set_limit(kept.limit());
      });
}

template <typename Kept>
void nearest_to(const PackedTree& tree, const Coordinates& center, Kept& kept) {
  if (tree.scalar == ScalarType::float32) {
    nearest_of(tree, tree.floats, center, kept);
  } else {
    nearest_of(tree, tree.doubles, center, kept);
  }
}

void list_nearest(const PackedTree& tree, const Coordinates& center, NearestSet& kept) {
  nearest_to(tree, center, kept);
}

void find_nearest(const PackedTree& tree, const Coordinates& center, NearestOne& kept) {
  nearest_to(tree, center, kept);
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_bv::detail {

void list_nearest(UsableIsa isa, const PackedTree& tree, const Coordinates& center, std::size_t most,
                  double limit, std::vector<Neighbor>& found) {
  static constexpr KernelTable kTable = PCL_BV_KERNEL_TABLE(list_nearest, &list_nearest_reference);
  NearestSet kept(most, limit, found);
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

}  // namespace pcl_bv::detail
#endif  // HWY_ONCE
