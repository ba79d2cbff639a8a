// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/kernels/swept_ball.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_bv::detail {

SweptBall::SweptBall(const BoxLevels& boxes, const Coordinates& start, const Coordinates& direction, double r)
    : from(start), radius(r) {
  // Floats are not precise enough if the distance of the start point or the radius exceeds 2^60 times the
  // size of the cloud.
  constexpr double kFar = 0x1p60;
  const int exponent =
      std::ilogb(std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)}));
  const double slope[3] = {std::ldexp(direction.x, -exponent), std::ldexp(direction.y, -exponent),
                           std::ldexp(direction.z, -exponent)};
  const double length = std::sqrt((slope[0] * slope[0] + slope[1] * slope[1]) + slope[2] * slope[2]);
  unit = {slope[0] / length, slope[1] / length, slope[2] / length};
  double size = 1 + radius * boxes.scale;
  for (std::size_t k = 0; k < 3; ++k) {
    const double position = (from[k] - boxes.origin[k]) * boxes.scale;
    size += std::abs(position);
    origin[k] = static_cast<float>(std::clamp(position, -kFar, kFar));
    // A slope below 2^-40 in magnitude is replaced by 2^-40 or -2^-40. The replacement moves the path of the
    // ball, where it is inside the boxes, by less than the margin.
    inverse[k] =
        static_cast<float>(1 / (slope[k] < 0 ? std::min(slope[k], -0x1p-40) : std::max(slope[k], 0x1p-40)));
  }
  time = std::ldexp(boxes.scale, exponent);
  margin = static_cast<float>(radius * boxes.scale + 0x1p-16 * size);
  if (size < kFar && std::isfinite(time) && time > 0x1p-960) return;
  margin = std::numeric_limits<float>::infinity();
  time = 1;
}

}  // namespace pcl_bv::detail
