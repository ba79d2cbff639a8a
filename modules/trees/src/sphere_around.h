// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A sphere around a box.
#pragma once

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/vector3.h"
#include "pcl_bv/volumes/sphere.h"
#include "spatial_order.h"
#include "vectors.h"

namespace pcl_bv::detail {

/// Returns a sphere around a box. The sphere is empty for an empty or infinite box. Rounding errors are below
/// 2^-50 of radius + |low|_1 + |high|_1, so the radius grows by 2^-45 of this sum.
inline Sphere sphere_around(const PositionBounds& box) {
  const Eigen::Vector3d low = vector(box.low), high = vector(box.high);
  if (!(low.x() <= high.x()) || !low.allFinite() || !high.allFinite()) return {};
  const Eigen::Vector3d middle = 0.5 * low + 0.5 * high;
  const double radius = (high - middle).stableNorm();
  return {middle, radius + 0x1p-45 * (radius + taxicab3(low) + taxicab3(high)) + kSmallestNormal};
}

}  // namespace pcl_bv::detail
