// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <stdexcept>

namespace pcl_bv {

/// What Neighbor::squared_distance may be for points within a distance; for one below 0 or NaN it throws.
inline double square_limit(double distance) {
  if (!(distance >= 0)) throw std::invalid_argument("PointTree: a distance must be 0 or more");
  return distance * distance;
}

}  // namespace pcl_bv
