// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Powers of two and one origin.

#include "local_frame.h"

#include <algorithm>
#include <cmath>

namespace pcl_bv {

LocalFrame::LocalFrame(const PointView& points, const Extremes& extremes)
    : origin_(vector(extremes.low_point[0].point)), extent_(0) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    extent_ = std::max(extent_, extremes.high[axis] - extremes.low[axis]);
  scale_ = extent_ > 0 ? std::ldexp(1.0, -std::clamp(std::ilogb(extent_), -1000, 1000)) : 1.0;
  kernel_scale_ = points.scalar == ScalarType::float64 ? scale_ : 1.0;
}

}  // namespace pcl_bv
