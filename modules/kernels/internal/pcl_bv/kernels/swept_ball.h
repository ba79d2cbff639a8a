// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The points of a tree that a moving ball may touch.
#pragma once

#include <cstddef>
#include <cstdint>

#include "pcl_bv/kernels/packed_tree.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// A ball whose centre moves along from + t direction, t >= 0: its line, and what the boxes of a tree are
/// asked. Times there are those of a direction whose longest coordinate is from 1 to 2.
struct SweptBall {
  float origin[3], inverse[3];  ///< In the frame of the boxes.
  float pad;    ///< What every box is greater by: the radius, and a thousand times what rounding to float
                ///< moves a place by. Infinity where floats tell nothing: then every box is entered at 0.
  double time;  ///< Times there of times here.
  Coordinates from, unit;  ///< The line in the unit of the points.
  double radius;

  /// A point is shown if it is at most radius + kDoubt |q|_1 + kLeast from the line, q from `from` to it.
  static constexpr double kDoubt = 0x1p-40, kLeast = 0x1p-400;

  /// All finite, the direction not 0, the radius at least 0.
  SweptBall(const BoxLevels& boxes, const Coordinates& from, const Coordinates& direction, double radius);

  /// Boxes that are entered later need not be asked about what comes before t.
  float latest(double t) const { return static_cast<float>(t * time * (1 + 0x1p-16)) + pad; }
};

/// Told by visit_along() which points to ask.
class PacketVisitor {
 public:
  /// The points of a packet whose bits are set, one at least, may be touched. Returns the time, in the frame
  /// of the boxes, from which on no box is entered any more: SweptBall::latest() of the first touch so far,
  /// and the greatest float before there is one.
  virtual float visit(std::size_t packet, std::uint32_t points) = 0;

 protected:
  ~PacketVisitor() = default;
};

/// Visits packets, those entered early first, until no point that was not shown can be touched before the
/// visitor's latest time. A point that is touched, as Sphere(point, radius).intersect() has it, is shown for
/// every `isa`; which others are is not the same. An empty tree has none. Runs in the caller's
/// floating-point environment: hold a FloatEnvironment.
void visit_along(UsableIsa isa, const PackedTree& tree, const SweptBall& ball, PacketVisitor& visitor);

}  // namespace pcl_bv
