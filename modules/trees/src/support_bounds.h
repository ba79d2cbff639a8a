// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Upper bounds of a volume's projections on the directions of kCubeDirections.
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

/// Upper bounds, by exact arithmetic, of the projections d . p (up) and -d . p (down) of all points p of a
/// non-empty volume, for each direction d of kCubeDirections. They are infinite where no bound is proven.
struct CubeSupportBounds {
  std::array<double, kMaxDirections> up, down;
};

/// Computes the bounds along the first `count` directions. The other bounds stay unset.
CubeSupportBounds cube_support_bounds(const AnyVolume& volume, std::size_t count);

}  // namespace pcl_bv
