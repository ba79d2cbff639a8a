// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Conversions between Coordinates and Eigen vectors.
#pragma once

#include <Eigen/Core>

#include "pcl_bv/numeric/coordinates.h"

namespace pcl_bv::detail {

inline Coordinates coordinates(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

inline Eigen::Vector3d vector(const Coordinates& c) {
  return {c.x, c.y, c.z};
}

}  // namespace pcl_bv::detail
