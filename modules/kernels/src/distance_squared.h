// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// squared_distance() as an inline function. It must not be in a public header, because public headers are
// compiled with the user's flags, which may change the rounding of the function.
#pragma once

#include "pcl_bv/kernels/distances.h"
#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv::detail {

template <typename T>
inline Coordinates load_as(const PointView& points, std::size_t i) {
  T v[3];
  load_point(points, i, v);
  return {v[0], v[1], v[2]};
}

inline double distance_squared(const Coordinates& p, const DistanceCenter& center) {
  const Coordinates q = {(p.x - center.x) * center.scale, (p.y - center.y) * center.scale,
                         (p.z - center.z) * center.scale};
  return dot3(q, q);
}

}  // namespace pcl_bv::detail
