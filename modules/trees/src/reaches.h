// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "pcl_bv/numeric/directions.h"
#include "pcl_bv/volumes/any_volume.h"

namespace pcl_bv {

inline Eigen::Vector3d cube_vector(std::size_t i) {
  const CubeDirection& d = kCubeDirections[i];
  return {static_cast<double>(d[0]), static_cast<double>(d[1]), static_cast<double>(d[2])};
}

/// Upper bounds of d . p and of -d . p, by exact arithmetic, over the points of a volume that is not empty,
/// along the directions of the cube. Infinite where there is none.
struct Reaches {
  std::array<double, kMaxDirections> up, down;
};

/// Of the first `count` directions.
Reaches reaches(const AnyVolume& volume, std::size_t count);

}  // namespace pcl_bv
