// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <bit>
#include <cmath>
#include <compare>
#include <cstddef>
#include <limits>

#include "pcl_bv/kernels/swept_ball.h"
#include "references.h"
#include "targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tree_swept_ball.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "packed_tree-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv::detail {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

// Returns, as bits, the boxes of a group that the ball enters within `latest` steps. Writes the steps of
// all boxes, entered or not.
HWY_INLINE std::uint32_t entered_boxes(const BoxGroup& group, const SweptBall& ball, float latest,
                                       float* steps) {
  const Floats d;
  const auto* bytes = reinterpret_cast<const std::byte*>(&group);
  std::uint32_t bits = 0;
  for (std::size_t k = 0; k < kTreeWidth; k += hn::Lanes(d)) {
    const auto at = [&](std::size_t side, std::size_t axis, float offset) HWY_ATTR {
      const auto sides = hn::Load(d, reinterpret_cast<const float*>(bytes + side) + k);
      return hn::MulSub(sides, hn::Set(d, ball.inverse[axis]), hn::Set(d, offset));
    };
    const auto near = [&](std::size_t axis)
                          HWY_ATTR { return at(ball.near_side[axis], axis, ball.to_near[axis]); };
    const auto far = [&](std::size_t axis)
                         HWY_ATTR { return at(ball.far_side[axis], axis, ball.to_far[axis]); };
    const auto enter = hn::Max(hn::Max(near(0), near(1)), hn::Max(near(2), hn::Zero(d)));
    const auto leave = hn::Min(hn::Min(far(0), far(1)), hn::Min(far(2), hn::Set(d, latest)));
    hn::Store(enter, d, steps + k);
    bits |= bits_of_lanes(d, hn::Le(enter, leave)) << k;
  }
  return bits;
}

// The line of the ball's centre in numbers of type T, and the largest squared distance of a point from the
// line at which the ball may touch the point. Numbers beyond the range of T become infinite.
template <typename T>
struct CentreLine {
  T start[3], rest[3];  // the start point is start + rest
  T unit[3];
  T largest_square;

  explicit CentreLine(const SweptBall& ball) {
    double offset = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      start[axis] = rounded(ball.from[axis]);
      rest[axis] = rounded(ball.from[axis] - double{start[axis]});
      unit[axis] = static_cast<T>(ball.unit[axis]);
      offset += std::abs(ball.from[axis]);
    }
    // `rest` has an error of 2^-48 of the start point. It exceeds that of the points if these are near each
    // other but far from 0.
    const double far =
        ball.radius + (sizeof(T) == 4 ? 0x1p-18 * ball.offset_bound + 0x1p-45 * offset : ball.error);
    largest_square = rounded(far * far + double{std::numeric_limits<T>::min()});
  }

 private:
  static T rounded(double x) {
    constexpr double kMax = std::numeric_limits<T>::max();
    return std::abs(x) <= kMax ? static_cast<T>(x)
                               : std::copysign(std::numeric_limits<T>::infinity(), T(x > 0 ? 1 : -1));
  }
};

// Returns, as bits, the points whose distance from the whole line may be at most the radius. A point whose
// distance is NaN, for example because it overflows, is one of them.
template <typename T>
HWY_INLINE std::uint32_t near_line(const PointPacket<T>& packet, const CentreLine<T>& line) {
  const Tag<T> d;
  const auto unit_x = hn::Set(d, line.unit[0]), unit_y = hn::Set(d, line.unit[1]),
             unit_z = hn::Set(d, line.unit[2]);
  std::uint32_t bits = 0;
  for (std::size_t k = 0; k < kTreeWidth; k += hn::Lanes(d)) {
    const auto from_start = [&](std::size_t axis) HWY_ATTR {
      return hn::Sub(hn::Sub(hn::Load(d, packet.at(axis, k)), hn::Set(d, line.start[axis])),
                     hn::Set(d, line.rest[axis]));
    };
    const auto x = from_start(0), y = from_start(1), z = from_start(2);
    const auto u = hn::MulSub(y, unit_z, hn::Mul(z, unit_y)), v = hn::MulSub(z, unit_x, hn::Mul(x, unit_z)),
               w = hn::MulSub(x, unit_y, hn::Mul(y, unit_x));
    const auto square = hn::MulAdd(w, w, hn::MulAdd(v, v, hn::Mul(u, u)));
    bits |= bits_of_lanes(d, hn::Not(hn::Gt(square, hn::Set(d, line.largest_square)))) << k;
  }
  return bits;
}

// A group whose box the ball enters, but whose boxes were not tested yet. One number, because it is loaded as
// a whole just after it was stored, and the processor forwards only whole stores. Groups compare by the steps
// until the ball enters.
class EnteredGroup {
 public:
  EnteredGroup() = default;
  EnteredGroup(float steps, std::size_t level, std::size_t number)
      : packed_(std::uint64_t{std::bit_cast<std::uint32_t>(steps)} << 32 | level << kNumberBits | number) {}

  float steps() const { return std::bit_cast<float>(static_cast<std::uint32_t>(packed_ >> 32)); }
  std::size_t level() const { return packed_ >> kNumberBits & (0xFFFFFFFFU >> kNumberBits); }
  std::size_t number() const { return packed_ & ((1U << kNumberBits) - 1); }
  auto operator<=>(const EnteredGroup&) const = default;  // steps are not negative

 private:
  static constexpr unsigned kNumberBits = 28;  // a tree has fewer than 2^31 points, and 256 to a group

  std::uint64_t packed_;
};

// Walks through the tree depth first. Of the groups in a group, the first to be entered is visited first.
// The order of packets in a group is that of the tree: finding the nearest would take longer than a packet.
template <typename T>
class WalkAlong {
 public:
  WalkAlong(const PackedTree& tree, const std::vector<PointPacket<T>>& packets, const SweptBall& ball,
            PacketVisitor& visitor)
      : boxes_(tree.boxes), packets_(packets.data()), ball_(ball), line_(ball), visitor_(visitor) {}

  HWY_INLINE void run() {
    const std::size_t level = start_level(boxes_);
    for (std::size_t group = 0; group * kTreeWidth < boxes_.child_counts[level]; ++group)
      test_group(level, group);
    while (count_ > 0) {
      const EnteredGroup next = entered_[--count_];
      if (next.steps() <= latest_) test_group(next.level(), next.number());
    }
  }

 private:
  HWY_INLINE void test_group(std::size_t level, std::size_t number) {
    HWY_ALIGN float steps[kTreeWidth];
    const std::uint32_t bits =
        entered_boxes(boxes_.groups[boxes_.first[level] + number], ball_, latest_, steps);
    if (level == 0) {
      visit_packets(number * kTreeWidth, bits, steps);
    } else {
      push_groups(level - 1, number * kTreeWidth, bits, steps);
    }
  }

  HWY_INLINE void visit_packets(std::size_t first, std::uint32_t bits, const float* steps) {
    for (; bits != 0; bits &= bits - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(bits));
      if (steps[k] > latest_) continue;
      const std::uint32_t points = near_line(packets_[first + k], line_);
      if (points != 0) latest_ = visitor_.visit(first + k, points);
    }
  }

  HWY_INLINE void push_groups(std::size_t level, std::size_t first, std::uint32_t bits, const float* steps) {
    const std::size_t bottom = count_;
    for (; bits != 0; bits &= bits - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(bits));
      const EnteredGroup group(steps[k], level, first + k);
      std::size_t at = count_++;  // insertion sort, because mostly few boxes are entered
      for (; at > bottom && entered_[at - 1] < group; --at)
        entered_[at] = entered_[at - 1];
      entered_[at] = group;
    }
  }

  const BoxLevels& boxes_;
  const PointPacket<T>* packets_;
  const SweptBall& ball_;
  const CentreLine<T> line_;
  PacketVisitor& visitor_;
  float latest_ = std::numeric_limits<float>::max();
  std::size_t count_ = 0;
  EnteredGroup entered_[kMaxStartBoxes + BoxLevels::kMaxLevels * kTreeWidth];
};

void visit_along(const PackedTree& tree, const SweptBall& ball, PacketVisitor& visitor) {
  if (tree.scalar == ScalarType::float32) {
    WalkAlong<float>(tree, tree.floats, ball, visitor).run();
  } else {
    WalkAlong<double>(tree, tree.doubles, ball, visitor).run();
  }
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pcl_bv::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_bv::detail {

void visit_along(UsableIsa isa, const PackedTree& tree, const SweptBall& ball, PacketVisitor& visitor) {
  static constexpr KernelTable kTable = PCL_BV_KERNEL_TABLE(visit_along, &visit_along_reference);
  if (tree.count != 0) kTable[isa](tree, ball, visitor);
}

}  // namespace pcl_bv::detail
#endif  // HWY_ONCE
