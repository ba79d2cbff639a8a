// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/kernels/swept_ball.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/power_of_two.h"
#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv::detail {
namespace {

// The largest reach, in the frame of the boxes, for which floats are precise enough. Beyond it, the ball
// enters all boxes at distance 0.
constexpr double kFar = 0x1p60;

// Up to this binary exponent of the direction, and from its negative on, times have no other errors than
// relative ones.
constexpr int kMaxExponent = 500;

}  // namespace

SweptBall::SweptBall(const BoxLevels& boxes, const Coordinates& start, const Coordinates& direction, double r)
    : from(start), radius(r) {
  const int exponent =
      binary_exponent(std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)}));
  const double step[3] = {times_power_of_two(direction.x, -exponent),
                          times_power_of_two(direction.y, -exponent),
                          times_power_of_two(direction.z, -exponent)};
  const double scale = boxes.scale, step_length = norm3(step);
  unit = {step[0] / step_length, step[1] / step_length, step[2] / step_length};
  length = times_power_of_two(step_length, exponent);
  steps_per_distance = scale / step_length;
  double position[3], size = 1 + radius * scale;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    position[axis] = (start[axis] - boxes.origin[axis]) * scale;
    size += std::abs(position[axis]);
  }
  reach = size / scale;
  error = std::abs(exponent) <= kMaxExponent ? 0x1p-38 * reach : kInfinity;
  const bool is_far = !(size < kFar);
  const double pad = is_far ? 2 * kFar : radius * scale + 0x1p-19 * size;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // A step below 2^-40 in magnitude is replaced by 2^-40 or -2^-40. The replacement moves the path of the
    // ball, where it is inside the boxes, by less than the pad.
    const double ratio = std::clamp(1 / step[axis], -0x1p40, 0x1p40);
    inverse[axis] = static_cast<float>(is_far ? std::copysign(1, ratio) : ratio);
    const double factor = double{inverse[axis]}, at = is_far ? 0 : position[axis] * factor,
                 pad_along = pad * std::abs(factor);
    to_near[axis] = static_cast<float>(at + pad_along);
    to_far[axis] = static_cast<float>(at - pad_along);
    const std::size_t low = offsetof(BoxGroup, low) + axis * sizeof(BoxGroup::low[0]),
                      high = offsetof(BoxGroup, high) + axis * sizeof(BoxGroup::high[0]);
    near_side[axis] = factor < 0 ? high : low;
    far_side[axis] = factor < 0 ? low : high;
  }
}

float SweptBall::latest_entry(double distance) const {
  constexpr float kMost = std::numeric_limits<float>::max();
  const double steps = distance * steps_per_distance * (1 + 0x1p-20);
  return steps < double{kMost} ? static_cast<float>(steps) : kMost;
}

// The factor 2^-38 in `error` is 2^15 U, U = 2^-53, and |p - from|_1 is at most 3 S. The errors of the foot
// of the perpendicular are below 30 U |p - from|_1, here and in intersect(), those of its distance from the
// point below 60 U |p - from|_1, and the radius of intersect() is larger by at most 128 U |p - from|_1 +
// 8 U r. So `error` covers them thrice over. What is left of it covers the rounding of the difference of
// squares, which is at most 3 U (r + error)^2.
std::optional<TouchBounds> SweptBall::touch(const Coordinates& point, double latest) const {
  const Coordinates q = {point.x - from.x, point.y - from.y, point.z - from.z};
  const Coordinates across = cross3(q, unit);
  const double square = dot3(across, across), outer = radius + error, inner = radius - error;
  if (!(square <= outer * outer)) return std::nullopt;
  if (!(error < kInfinity)) return TouchBounds{0, kInfinity};
  const double foot = dot3(q, unit), half = std::sqrt(outer * outer - square);
  const double least = std::max(0.0, foot - half - error);
  if (foot + half < -error || least > latest) return std::nullopt;
  if (!(inner > 0 && square <= inner * inner)) return TouchBounds{least, kInfinity};
  const double least_half = std::sqrt(inner * inner - square);
  if (foot + least_half < error) return TouchBounds{least, kInfinity};
  return TouchBounds{least, std::max(0.0, foot - least_half) + error};
}

TouchBounds SweptBall::bounds_of_time(double t) const {
  if (!(error < kInfinity)) return {0, kInfinity};
  return {std::max(0.0, t * length - error), t * length + error};
}

}  // namespace pcl_bv::detail
