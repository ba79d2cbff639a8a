// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Finds the points of a tree that a moving ball may touch.
#pragma once

#include <cstddef>
#include <cstdint>

#include "pcl_bv/kernels/packed_tree.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// A ball whose centre moves along from + t * direction, t >= 0, prepared for tests against the boxes and
/// points of a tree. Times in the frame of the boxes refer to the direction scaled by a power of two, so that
/// its largest component is from 1 to 2 in magnitude there.
struct SweptBall {
  float origin[3], inverse[3];  ///< Start point and reciprocal direction in the frame of the boxes.
  float margin;  ///< Added to each side of every box: the radius and a bound of the rounding to float.
                 ///< Infinite if floats are not precise enough; then every box is entered at time 0.
  double time;   ///< Factor from times t to times in the frame of the boxes.
  Coordinates from, unit;  ///< Start point and unit direction, in the unit of the points.
  double radius;

  /// A point is shown to the visitor if its distance from the line is at most
  /// radius + kRelativeMargin |q|_1 + kAbsoluteMargin, with q the vector from `from` to the point.
  static constexpr double kRelativeMargin = 0x1p-40, kAbsoluteMargin = 0x1p-400;

  /// All arguments must be finite, the direction not 0, the radius at least 0.
  SweptBall(const BoxLevels& boxes, const Coordinates& from, const Coordinates& direction, double radius);

  /// Returns, in the frame of the boxes, a time so late that boxes entered after it contain no point that is
  /// touched before t.
  float latest_entry(double t) const { return static_cast<float>(t * time * (1 + 0x1p-16)) + margin; }
};

/// Receives the points that visit_along() finds.
class PacketVisitor {
 public:
  /// Called with a packet and, as bits, its points that may be touched (at least one bit is set). Returns the
  /// latest time, in the frame of the boxes, at which a box must be entered to be visited:
  /// SweptBall::latest_entry() of the first touch so far; before there is one, the largest float.
  virtual float visit(std::size_t packet, std::uint32_t points) = 0;

 protected:
  ~PacketVisitor() = default;
};

/// Visits packets until no other point can be touched before the visitor's latest time. Every point that the
/// ball touches by then, as decided by Sphere(point, radius).intersect(), is shown to the visitor for every
/// `isa`. Which other points are shown, and in which order, depends on `isa` (vector kernels visit boxes that
/// are entered early first). An empty tree has no points. The caller must hold a FloatEnvironment.
void visit_along(UsableIsa isa, const PackedTree& tree, const SweptBall& ball, PacketVisitor& visitor);

}  // namespace pcl_bv
