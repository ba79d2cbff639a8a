// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/kernels/swept_ball.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv::detail {
namespace {

// The largest reach, in the frame of the boxes, for which floats are precise enough. Beyond it, the ball
// enters all boxes at distance 0.
constexpr double kFar = 0x1p60;

// Between these lengths of the direction, times have no other errors than relative ones.
constexpr double kShortest = 0x1p-500, kLongest = 0x1p500;

// Returns a vector of the same direction, the squares of which are in the range of double.
Coordinates scaled_to_square(const Coordinates& direction, double largest) {
  if (largest > kShortest && largest < kLongest) return direction;
  const int exponent = std::ilogb(largest);
  return {std::ldexp(direction.x, -exponent), std::ldexp(direction.y, -exponent),
          std::ldexp(direction.z, -exponent)};
}

}  // namespace

SweptBall::SweptBall(const BoxLevels& boxes, const Coordinates& start, const Coordinates& direction, double r)
    : scale(boxes.scale), from(start), radius(r) {
  const double largest = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
  const Coordinates along = scaled_to_square(direction, largest);
  length = norm3(along);
  unit = {along.x / length, along.y / length, along.z / length};
  double position[3], size = 1 + radius * scale;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    position[axis] = (from[axis] - boxes.origin[axis]) * scale;
    size += std::abs(position[axis]);
  }
  reach = size / scale;
  error = largest > kShortest && largest < kLongest ? 0x1p-38 * reach : kInfinity;
  const bool is_far = !(size < kFar);
  const double pad = is_far ? 2 * kFar : radius * scale + 0x1p-19 * size;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // A component below 2^-40 in magnitude is replaced by 2^-40 or -2^-40. The replacement moves the path of
    // the ball, where it is inside the boxes, by less than the margin.
    const double step = unit[axis] < 0 ? std::min(unit[axis], -0x1p-40) : std::max(unit[axis], 0x1p-40);
    const double signed_pad = step < 0 ? -pad : pad, at = is_far ? 0 : position[axis];
    inverse[axis] = static_cast<float>(is_far ? std::copysign(1, step) : 1 / step);
    to_near[axis] = static_cast<float>((at + signed_pad) * double{inverse[axis]});
    to_far[axis] = static_cast<float>((at - signed_pad) * double{inverse[axis]});
    const std::size_t low = offsetof(BoxGroup, low) + axis * sizeof(BoxGroup::low[0]),
                      high = offsetof(BoxGroup, high) + axis * sizeof(BoxGroup::high[0]);
    near_side[axis] = step < 0 ? high : low;
    far_side[axis] = step < 0 ? low : high;
  }
}

float SweptBall::latest_entry(double distance) const {
  constexpr float kMost = std::numeric_limits<float>::max();
  const double in_frame = distance * scale * (1 + 0x1p-20);
  return in_frame < double{kMost} ? static_cast<float>(in_frame) : kMost;
}

// The factor 2^-38 in `error` is 2^15 U, U = 2^-53, and |p - from|_1 is at most 3 S. The errors of the foot
// of the perpendicular are below 30 U |p - from|_1, here and in intersect(), those of its distance from the
// point below 60 U |p - from|_1, and the radius of intersect() is larger by at most 128 U |p - from|_1 +
// 8 U r. So `error` covers them thrice over. What is left of it covers the rounding of the difference of
// squares, which is at most 3 U (r + error)^2.
std::optional<TouchBounds> SweptBall::touch(const Coordinates& point) const {
  const Coordinates q = {point.x - from.x, point.y - from.y, point.z - from.z};
  const Coordinates across = cross3(q, unit);
  const double square = dot3(across, across), outer = radius + error, inner = radius - error;
  if (!(square <= outer * outer)) return std::nullopt;
  if (!(error < kInfinity)) return TouchBounds{0, kInfinity};
  const double foot = dot3(q, unit), half = std::sqrt(outer * outer - square);
  if (foot + half < -error) return std::nullopt;
  TouchBounds bounds{std::max(0.0, foot - half - error), kInfinity};
  if (inner > 0 && square <= inner * inner) {
    const double least_half = std::sqrt(inner * inner - square);
    if (foot + least_half >= error) bounds.most = std::max(0.0, foot - least_half) + error;
  }
  return bounds;
}

TouchBounds SweptBall::bounds_of_time(double t) const {
  if (!(error < kInfinity)) return {0, kInfinity};
  return {std::max(0.0, t * length - error), t * length + error};
}

}  // namespace pcl_bv::detail
