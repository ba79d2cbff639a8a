// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Finds the points of a tree that a moving ball may touch.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "pcl_bv/kernels/packed_tree.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Bounds of the distance that a moving ball has covered when it touches a point, in the unit of the points.
struct TouchBounds {
  double min;  ///< 0 or more.
  double max;  ///< Infinity unless the ball certainly touches the point.

  /// Returns whether the ball may touch the point. If not, both bounds are infinite.
  bool is_possible() const { return min < kInfinity; }
};

/// A moving ball, prepared for tests against the boxes and points of a tree. Its centre starts at `from` and
/// moves along `unit`. Distances are lengths of the centre's path from `from`.
///
/// Let S, the offset bound, be at least the radius and at least each coordinate of p - from for every point p
/// of the tree. Rounding moves a ball by less than 2^-21 S in the tests of boxes, by less than 2^-20 S +
/// 2^-47 |from|_1 in tests of points in float, and by less than 2^-42 S in tests of points in double. In the
/// tests, the ball is larger by 4 to 16 times as much.
struct SweptBall {
  /// Along an axis, the ball may be between the sides of a box from near * inverse - `to_near` to far *
  /// inverse - `to_far`, in steps. One step is the direction, scaled by a power of two to a largest component
  /// in [1, 2), in the frame of the boxes (see BoxLevels).
  float inverse[3], to_near[3], to_far[3];
  std::size_t near_side[3], far_side[3];  ///< Offsets of the sides in a BoxGroup, in bytes.
  double steps_per_distance;
  Coordinates from, unit;  ///< Start point and unit direction, in the unit of the points.
  double radius;
  double length;  ///< Of the direction. A time t is the distance t * `length`.
  double offset_bound;  ///< S. At least 2^-400, because BoxLevels limits its scale.
  /// 2^-38 S. Infinite if the bounds of TouchBounds could not order the times, because times of different
  /// distances could be rounded to the same number, or clamped to the largest one.
  double error;

  /// All arguments must be finite, the direction not 0, the radius at least 0.
  SweptBall(const BoxLevels& boxes, const Coordinates& from, const Coordinates& direction, double radius);

  /// Returns a limit. Boxes that the ball enters after more steps contain no point that the ball touches
  /// before `distance`.
  float latest_entry(double distance) const;

  /// Returns bounds of enter * length, where `enter` is the result of Sphere(point, radius).intersect(). The
  /// bounds of two points that do not overlap have different times in the same order. is_possible() is false
  /// only if intersect() returns nothing, if a coordinate is NaN or if the lower bound is above `latest`.
  TouchBounds touch(const Coordinates& point, double latest) const;

  /// Returns bounds of t * length that hold for the rounding of t and can be compared with those of touch().
  TouchBounds bounds_of_time(double t) const;
};

inline float SweptBall::latest_entry(double distance) const {
  constexpr float kMaxFloat = std::numeric_limits<float>::max();
  const double steps = distance * steps_per_distance * (1 + 0x1p-20);
  return steps < double{kMaxFloat} ? static_cast<float>(steps) : kMaxFloat;
}

// The factor 2^-38 in `error` is 2^15 U, U = 2^-53, and |p - from|_1 is at most 3 S. The errors of the foot
// of the perpendicular are below 30 U |p - from|_1, here and in intersect(), those of its distance from the
// point below 60 U |p - from|_1, and the radius of intersect() is larger by at most 192 U |p - from|_1 +
// 12 U r. Together they are below 900 U S. What is left of `error` covers the rounding of the difference of
// squares, which is at most 3 U (r + error)^2.
inline TouchBounds SweptBall::touch(const Coordinates& point, double latest) const {
  const Coordinates q = {point.x - from.x, point.y - from.y, point.z - from.z};
  const Coordinates across = cross3(q, unit);
  const double square = dot3(across, across), outer = radius + error, inner = radius - error;
  constexpr TouchBounds kNever{kInfinity, kInfinity};
  if (!(square <= outer * outer)) return kNever;
  if (!(error < kInfinity)) return {0, kInfinity};
  const double foot = dot3(q, unit), half = std::sqrt(outer * outer - square);
  const double min = std::max(0.0, foot - half - error);
  if (foot + half < -error || min > latest) return kNever;
  if (!(inner > 0 && square <= inner * inner)) return {min, kInfinity};
  const double inner_half = std::sqrt(inner * inner - square);
  if (foot + inner_half < error) return {min, kInfinity};
  return {min, std::max(0.0, foot - inner_half) + error};
}

inline TouchBounds SweptBall::bounds_of_time(double t) const {
  if (!(error < kInfinity)) return {0, kInfinity};
  return {std::max(0.0, t * length - error), t * length + error};
}

/// The interface through which visit_along() passes the points that it finds.
class PacketVisitor {
 public:
  /// Called with the index of a packet and with one bit per point of the packet. The bit is set if the ball
  /// may touch the point; at least one bit is set. Bits of unused points may be set. Returns the number
  /// of steps up to which the ball enters boxes that must still be visited. This is
  /// SweptBall::latest_entry() of the earliest touch so far, or the largest float before the first touch.
  virtual float visit(std::size_t packet, std::uint32_t points) = 0;

 protected:
  ~PacketVisitor() = default;
};

/// Calls visitor.visit() for packets until the ball enters all remaining boxes after the steps that visit()
/// returned last. With every `isa`, visit() receives every point that the ball touches up to these steps, as
/// decided by Sphere(point, radius).intersect(). The other points that visit() receives, and the order of
/// the calls, depend on `isa`. (Vector kernels mostly visit boxes with early entry first.) For an
/// empty tree visit() is not called. The caller must hold a FloatEnvironment.
void visit_along(UsableIsa isa, const PackedTree& tree, const SweptBall& ball, PacketVisitor& visitor);

}  // namespace detail
}  // namespace pcl_bv
