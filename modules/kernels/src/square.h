// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// squared_distance() where the compiler can see it. Not for public headers, whose users choose the flags.
#pragma once

#include "pcl_bv/kernels/distances.h"

namespace pcl_bv {

template <typename T>
inline Coordinates load_as(const PointView& points, std::size_t i) {
  T v[3];
  load_point(points, i, v);
  return {v[0], v[1], v[2]};
}

inline double square(const Coordinates& p, const DistanceCenter& center) {
  const double x = (p.x - center.x) * center.scale;
  const double y = (p.y - center.y) * center.scale;
  const double z = (p.z - center.z) * center.scale;
  return (x * x + y * y) + z * z;
}

}  // namespace pcl_bv
