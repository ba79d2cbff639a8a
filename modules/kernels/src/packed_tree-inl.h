// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Distances from a query point to the boxes of a group and to the points of a packet, and the walk down a
// tree.

// Compiled once per target of Highway's foreach_target.h.
#if defined(PCL_BV_PACKED_TREE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_BV_PACKED_TREE_INL_H_
#undef PCL_BV_PACKED_TREE_INL_H_
#else
#define PCL_BV_PACKED_TREE_INL_H_
#endif

#include <hwy/highway.h>

#include <bit>
#include <cstdint>
#include <type_traits>

#include "box_probe.h"
#include "load-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

using Floats = hn::CappedTag<float, kTreeWidth>;
// Doubles has half as many lanes as Floats.
using Doubles = hn::CappedTag<double, 8>;

/// Returns a mask of at most 16 lanes as bits. Reads exactly the bytes that StoreMaskBits() wrote, because a
/// longer read would have to wait for the store.
template <class D>
HWY_INLINE std::uint32_t bits_of_lanes(D d, hn::Mask<D> mask) {
  static_assert(hn::MaxLanes(d) <= 16);
  std::conditional_t<hn::MaxLanes(d) <= 8, std::uint8_t, std::uint16_t> bits = 0;
  hn::StoreMaskBits(d, mask, reinterpret_cast<std::uint8_t*>(&bits));
  return bits;
}

template <class D>
HWY_INLINE V<D> sum_of_squares(V<D> x, V<D> y, V<D> z) {
  return hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
}

/// Returns the distances, along one axis, from the query point to the boxes k, k + 1, ... of a group. A
/// distance is 0 if the query point may be between the sides of the box.
template <class D>
HWY_INLINE V<D> gap(D d, const BoxGroup& group, const BoxProbe& probe, std::size_t axis, std::size_t k) {
  const auto below = hn::Sub(hn::Load(d, group.low[axis] + k), hn::Set(d, probe.high[axis]));
  const auto above = hn::Sub(hn::Set(d, probe.low[axis]), hn::Load(d, group.high[axis] + k));
  return hn::Max(hn::Max(below, above), hn::Zero(d));
}

template <class D>
HWY_INLINE V<D> nearest_squares(D d, const BoxGroup& group, const BoxProbe& probe, std::size_t k) {
  return sum_of_squares<D>(gap(d, group, probe, 0, k), gap(d, group, probe, 1, k),
                           gap(d, group, probe, 2, k));
}

/// Computes two squared upper bounds for each box along one axis. `nearer` is for the distance to a point on
/// the nearer side of the box, and `farther` for the distance to the farther side. Boxes were rounded outward
/// by at most 2^-20. So the point that determines a side may be up to 2^-20 inside the box.
template <class D>
HWY_INLINE void side_squares(D d, const BoxGroup& group, const BoxProbe& probe, std::size_t axis,
                             std::size_t k, V<D>& nearer, V<D>& farther) {
  const auto low = hn::Load(d, group.low[axis] + k), high = hn::Load(d, group.high[axis] + k);
  const auto least = hn::Set(d, probe.low[axis]), most = hn::Set(d, probe.high[axis]);
  const auto to_low = hn::Max(hn::Sub(most, low), hn::Sub(low, least));
  const auto to_high = hn::Max(hn::Sub(high, least), hn::Sub(most, high));
  const auto near = hn::Add(hn::Min(to_low, to_high), hn::Set(d, 0x1p-20F));
  const auto far = hn::Max(to_low, to_high);
  nearer = hn::Mul(near, near);
  farther = hn::Mul(far, far);
}

/// Returns a squared upper bound of the distance to the nearest point in each box (Roussopoulos et al. 1995).
/// A box around points has a point on each side. So a point of the box is no farther away than the farthest
/// corner of the nearer side along x. The same holds for y and z. The bound is the smallest of these three
/// distances.
template <class D>
HWY_INLINE V<D> nearest_point_bounds(D d, const BoxGroup& group, const BoxProbe& probe, std::size_t k) {
  V<D> near_x, near_y, near_z, far_x, far_y, far_z;
  side_squares(d, group, probe, 0, k, near_x, far_x);
  side_squares(d, group, probe, 1, k, near_y, far_y);
  side_squares(d, group, probe, 2, k, near_z, far_z);
  const auto across_x = hn::Add(near_x, hn::Add(far_y, far_z));
  const auto across_y = hn::Add(near_y, hn::Add(far_x, far_z));
  const auto across_z = hn::Add(near_z, hn::Add(far_x, far_y));
  return hn::Min(hn::Min(across_x, across_y), across_z);
}

/// Returns, as bits, which of the first `count` boxes of a group may have a point within the limit.
HWY_INLINE std::uint32_t near_boxes(const BoxGroup& group, const BoxProbe& probe, std::size_t count) {
  const Floats d;
  std::uint32_t bits = 0;
  for (std::size_t k = 0; k < kTreeWidth; k += hn::Lanes(d)) {
    const auto near = hn::Le(nearest_squares(d, group, probe, k), hn::Set(d, probe.outer));
    bits |= bits_of_lanes(d, near) << k;
  }
  return bits & ((1U << count) - 1);
}

/// Returns, as bits, the boxes that may contain the query point. Faster than near_boxes(), because no
/// distances are computed.
HWY_INLINE std::uint32_t boxes_around(const BoxGroup& group, const BoxProbe& probe) {
  const Floats d;
  std::uint32_t bits = 0;
  for (std::size_t k = 0; k < kTreeWidth; k += hn::Lanes(d)) {
    const auto inside = [&](std::size_t axis) HWY_ATTR {
      return hn::And(hn::Le(hn::Load(d, group.low[axis] + k), hn::Set(d, probe.high[axis])),
                     hn::Ge(hn::Load(d, group.high[axis] + k), hn::Set(d, probe.low[axis])));
    };
    bits |= bits_of_lanes(d, hn::And(hn::And(inside(0), inside(1)), inside(2))) << k;
  }
  return bits;
}

/// Returns whether a box of the group is so near that it certainly has a point within the limit. Empty boxes
/// are infinitely far.
HWY_INLINE bool contains_near_point(const BoxGroup& group, const BoxProbe& probe) {
  const Floats d;
  for (std::size_t k = 0; k < kTreeWidth; k += hn::Lanes(d)) {
    const auto bounds = nearest_point_bounds(d, group, probe, k);
    if (!hn::AllFalse(d, hn::Le(bounds, hn::Set(d, probe.inner)))) return true;
  }
  return false;
}

template <class D>
HWY_INLINE V<D> load_as_double(D d, const double* from) {
  return hn::Load(d, from);
}

template <class D>
HWY_INLINE V<D> load_as_double(D d, const float* from) {
  return hn::PromoteTo(d, hn::Load(hn::Rebind<float, D>(), from));
}

/// Returns the squared distances, as defined for Neighbor, of the points k, k + 1, ... of a packet.
template <class D, typename T>
HWY_INLINE V<D> packet_squares(D d, const PointPacket<T>& packet, const Coordinates& center, std::size_t k) {
  return sum_of_squares<D>(hn::Sub(load_as_double(d, packet.at(0, k)), hn::Set(d, center.x)),
                           hn::Sub(load_as_double(d, packet.at(1, k)), hn::Set(d, center.y)),
                           hn::Sub(load_as_double(d, packet.at(2, k)), hn::Set(d, center.z)));
}

/// Returns, as bits, the points of a packet within the limit. Writes all squared distances if `squares` is
/// not null.
template <typename T>
HWY_INLINE std::uint32_t near_points(const PointPacket<T>& packet, const Coordinates& center, double limit,
                                     double* squares) {
  const Doubles d;
  std::uint32_t bits = 0;
  for (std::size_t k = 0; k < kTreeWidth; k += hn::Lanes(d)) {
    const auto square = packet_squares(d, packet, center, k);
    if (squares != nullptr) hn::Store(square, d, squares + k);
    bits |= bits_of_lanes(d, hn::Le(square, hn::Set(d, limit))) << k;
  }
  return bits;
}

constexpr std::size_t kMaxStartBoxes = 64;  // width of Open::bits

/// Returns the lowest level with at most 64 boxes. Walks start there, because testing all these boxes takes
/// less time than testing the boxes of the levels above.
HWY_INLINE std::size_t start_level(const BoxLevels& boxes) {
  std::size_t level = boxes.levels - 1;
  while (level > 0 && boxes.child_counts[level - 1] <= kMaxStartBoxes)
    --level;
  return level;
}

/// Walks down a tree. Calls visit.visit_packet(packet) for each packet whose box may have a point within the
/// limit. When the walk enters a group and any of its boxes may have such a point, first calls
/// visit.test_group(index of the group). The groups at the start are not tested. Returns true as soon as
/// visit_packet() or test_group() returns true, else false.
///
/// The walk starts at start_level().
///
/// visit.preferred_box(group) returns bits. The box of the lowest set bit is visited before the other boxes
/// of the group, even if near_boxes() excludes this box. The other boxes follow in ascending order.
template <typename Visit>
HWY_INLINE bool walk(const BoxLevels& boxes, const BoxProbe& probe, const Visit& visit) {
  struct Open {
    std::size_t first;   // item of bit 0
    std::uint64_t bits;  // items still to be visited
  };
  Open open[BoxLevels::kMaxLevels];
  const std::size_t start = start_level(boxes);
  std::size_t level = start;
  std::uint64_t next = 0;
  open[level] = {0, 0};
  for (std::size_t first = 0; first < boxes.child_counts[level]; first += kTreeWidth) {
    const BoxGroup& group = boxes.groups[boxes.first[level] + first / kTreeWidth];
    const std::uint64_t near =
        near_boxes(group, probe, HWY_MIN(boxes.child_counts[level] - first, kTreeWidth));
    open[level].bits |= near << first;
    next |= std::uint64_t{visit.preferred_box(group)} << first;
  }
  for (;;) {
    while (next == 0) {
      next = open[level].bits;
      if (next == 0 && level++ == start) return false;
    }
    const auto k = static_cast<std::size_t>(std::countr_zero(next));
    const std::size_t item = open[level].first + k;
    open[level].bits &= ~(std::uint64_t{1} << k);
    next = 0;
    if (level == 0) {
      if (visit.visit_packet(item)) return true;
      continue;
    }
    --level;
    const std::size_t number = boxes.first[level] + item, first = item * kTreeWidth;
    const BoxGroup& group = boxes.groups[number];
    next = visit.preferred_box(group);
    open[level] = {first, near_boxes(group, probe, HWY_MIN(boxes.child_counts[level] - first, kTreeWidth))};
    if (open[level].bits != 0 && visit.test_group(number)) return true;
  }
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv::detail
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
