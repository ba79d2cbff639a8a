// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "local_frame.h"

#include <algorithm>
#include <cmath>

namespace pcl_bv::detail {

double widest_side(const Supports& supports) {
  double widest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    widest = std::max(widest, supports.along[axis].high - supports.along[axis].low);
  return widest;
}

double unit_scale(double extent) {
  return extent > 0 ? std::ldexp(1.0, -std::clamp(std::ilogb(extent), -1000, 1000)) : 1.0;
}

LocalFrame::LocalFrame(const Supports& supports)
    : origin_(vector(supports.along[0].low_point.point)),
      extent_(widest_side(supports)),
      scale_(unit_scale(extent_)),
      kernel_scale_(supports.points.scalar == ScalarType::float64 ? scale_ : 1.0) {}

}  // namespace pcl_bv::detail
