// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <limits>

#include "pcl_bv/kernels/swept_ball.h"
#include "references.h"
#include "targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tree_swept_ball.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "tree_descent-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_bv::detail {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

// Returns the times at which the ball enters the boxes k, k + 1, ... of a group. The time is infinity for
// boxes that the ball does not enter.
HWY_INLINE V<Floats> enter_times(Floats d, const BoxGroup& group, const SweptBall& ball, std::size_t k) {
  auto enter = hn::Zero(d), leave = hn::Inf(d);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool up = ball.inverse[axis] > 0;
    const float margin = up ? ball.margin : -ball.margin;
    const auto origin = hn::Set(d, ball.origin[axis]), inverse = hn::Set(d, ball.inverse[axis]);
    const auto low = hn::Load(d, (up ? group.low : group.high)[axis] + k);
    const auto high = hn::Load(d, (up ? group.high : group.low)[axis] + k);
    enter = hn::Max(enter, hn::Mul(hn::Sub(hn::Sub(low, hn::Set(d, margin)), origin), inverse));
    leave = hn::Min(leave, hn::Mul(hn::Sub(hn::Add(high, hn::Set(d, margin)), origin), inverse));
  }
  return hn::IfThenElse(hn::Le(enter, leave), enter, hn::Inf(d));
}

// Returns, as bits, the points whose distance from the whole line may be at most the radius. A point with a
// NaN is never returned. Let q be the vector from ball.from to the point, and d the direction. The error of
// |q x d| is below 2^-48 |q|_1 |d|. kRelativeMargin |q|_1 covers this error and the margin that
// Sphere::intersect() adds to a radius.
template <typename T>
HWY_INLINE std::uint32_t near_line(const PointPacket<T>& packet, const SweptBall& ball) {
  const Doubles d;
  const auto unit_x = hn::Set(d, ball.unit.x), unit_y = hn::Set(d, ball.unit.y),
             unit_z = hn::Set(d, ball.unit.z);
  std::uint32_t bits = 0;
  for (std::size_t k = 0; k < kTreeWidth; k += hn::Lanes(d)) {
    const auto x = hn::Sub(load_as_double(d, packet.at(0, k)), hn::Set(d, ball.from.x));
    const auto y = hn::Sub(load_as_double(d, packet.at(1, k)), hn::Set(d, ball.from.y));
    const auto z = hn::Sub(load_as_double(d, packet.at(2, k)), hn::Set(d, ball.from.z));
    const auto square = sum_of_squares<Doubles>(hn::Sub(hn::Mul(y, unit_z), hn::Mul(z, unit_y)),
                                                hn::Sub(hn::Mul(z, unit_x), hn::Mul(x, unit_z)),
                                                hn::Sub(hn::Mul(x, unit_y), hn::Mul(y, unit_x)));
    const auto error_bound =
        hn::Mul(hn::Add(hn::Add(hn::Abs(x), hn::Abs(y)), hn::Abs(z)), hn::Set(d, SweptBall::kRelativeMargin));
    const auto far = hn::Add(error_bound, hn::Set(d, ball.radius + SweptBall::kAbsoluteMargin));
    bits |= bits_of_lanes(d, hn::Le(square, hn::Mul(far, far))) << k;
  }
  return bits;
}

template <typename T>
void along(const PackedTree& tree, const std::vector<PointPacket<T>>& packets, const SweptBall& ball,
           PacketVisitor& visitor) {
  float latest = std::numeric_limits<float>::max();
  descend(
      tree.boxes,
      [&](Floats d, const BoxGroup& group, std::size_t k) { return enter_times(d, group, ball, k); }, latest,
      [&](std::size_t packet) {
        const std::uint32_t points = near_line(packets[packet], ball);
        if (points != 0) latest = visitor.visit(packet, points);
      });
}

void visit_along(const PackedTree& tree, const SweptBall& ball, PacketVisitor& visitor) {
  if (tree.scalar == ScalarType::float32) {
    along(tree, tree.floats, ball, visitor);
  } else {
    along(tree, tree.doubles, ball, visitor);
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
