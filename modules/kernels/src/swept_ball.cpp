// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/kernels/swept_ball.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/power_of_two.h"
#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv::detail {
namespace {

// The largest offset bound, in the frame of the boxes, for which floats are precise enough. Beyond it, the
// ball enters all boxes at distance 0.
constexpr double kFar = 0x1p60;

// Up to this binary exponent of the direction and this offset bound, and from their negative and inverse on,
// times have no other errors than relative ones: they neither underflow nor overflow.
constexpr int kMaxExponent = 500;
constexpr double kMaxOffset = 0x1p400;

}  // namespace

SweptBall::SweptBall(const BoxLevels& boxes, const Coordinates& start, const Coordinates& direction, double r)
    : from{start.x, start.y, start.z}, radius(r) {
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
  offset_bound = size / scale;
  const bool is_ordered =
      std::abs(exponent) <= kMaxExponent && offset_bound > 1 / kMaxOffset && offset_bound < kMaxOffset;
  error = is_ordered ? 0x1p-38 * offset_bound : kInfinity;
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

}  // namespace pcl_bv::detail
