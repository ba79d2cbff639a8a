// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Finds the points of a tree that a moving ball may touch.
#pragma once

#include <cstddef>
#include <cstdint>

#include "pcl_bv/kernels/packed_tree.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// A moving ball, prepared for tests against the boxes and points of a tree. At the time t >= 0, its centre
/// is at `from` + t * `direction`. In the frame of the boxes (see BoxLevels), the direction is scaled by a
/// power of two so that its largest component is from 1 to 2 in magnitude. Times in this frame refer to the
/// scaled direction.
struct SweptBall {
  float origin[3], inverse[3];  ///< Start point, and 1 / direction per axis, in the frame of the boxes.
  float margin;  ///< The radius plus a bound of the rounding to float. It is added to each side of every box.
                 ///< Infinite if floats are not precise enough; then every box is entered at time 0.
  double time;   ///< Factor that converts a time t to a time in the frame of the boxes.
  Coordinates from, unit;  ///< Start point and unit direction, in the unit of the points.
  double radius;

  /// visit_along() passes a point of a visited packet to PacketVisitor::visit() if the distance of the point
  /// from the line is at most radius + kRelativeMargin |q|_1 + kAbsoluteMargin, where q is the vector from
  /// `from` to the point.
  static constexpr double kRelativeMargin = 0x1p-40, kAbsoluteMargin = 0x1p-400;

  /// All arguments must be finite, the direction not 0, the radius at least 0.
  SweptBall(const BoxLevels& boxes, const Coordinates& from, const Coordinates& direction, double radius);

  /// Returns a time in the frame of the boxes. Boxes that the ball enters after this time contain no point
  /// that the ball touches before t.
  float latest_entry(double t) const { return static_cast<float>(t * time * (1 + 0x1p-16)) + margin; }
};

/// The interface through which visit_along() passes the points that it finds.
class PacketVisitor {
 public:
  /// Called with the index of a packet and with one bit per point of the packet. The bit is set if the ball
  /// may touch the point; at least one bit is set. Returns the latest entry time, in the frame of the boxes,
  /// of boxes that must still be visited. This is SweptBall::latest_entry() of the earliest touch so far, or
  /// the largest float before the first touch.
  virtual float visit(std::size_t packet, std::uint32_t points) = 0;

 protected:
  ~PacketVisitor() = default;
};

/// Calls visitor.visit() for packets until the ball enters all remaining boxes after the time that visit()
/// returned last. With every `isa`, visit() receives every point that the ball touches up to that time, as
/// decided by Sphere(point, radius).intersect(). The other points that visit() receives, and the order of the
/// calls, depend on `isa`. (Vector kernels visit boxes with early entry times first.) For an empty tree
/// visit() is not called. The caller must hold a FloatEnvironment.
void visit_along(UsableIsa isa, const PackedTree& tree, const SweptBall& ball, PacketVisitor& visitor);

}  // namespace detail
}  // namespace pcl_bv
