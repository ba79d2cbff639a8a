// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/trees/slab_bounds.h"

#include <cmath>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/numeric/vector3.h"
#include "support_bounds.h"

namespace pcl_bv {
namespace {

template <typename T>
T rounded_up(double x) {
  if constexpr (sizeof(T) == 4) {
    return float_up(x);
  } else {
    return x;
  }
}

}  // namespace

template <std::size_t N, typename T>
SlabBounds<N, T>::SlabBounds(const Aabb& box) : SlabBounds(AnyVolume(box)) {}

template <std::size_t N, typename T>
SlabBounds<N, T>::SlabBounds(const AnyVolume& volume) : SlabBounds() {
  if (pcl_bv::empty(volume)) return;
  const FloatEnvironment environment;
  const CubeSupportBounds found = cube_support_bounds(volume, N);
  for (std::size_t i = 0; i < N; ++i) {
    min[i] = T(0) - rounded_up<T>(found.down[i]);  // never -0
    max[i] = T(0) + rounded_up<T>(found.up[i]);
  }
}

// The rounding error of a sum of three terms is at most 2 * 2^-53 times the sum of their magnitudes.
template <std::size_t N, typename T>
bool SlabBounds<N, T>::contains(const Eigen::Vector3d& point) const {
  const FloatEnvironment environment;
  for (std::size_t i = 0; i < N; ++i) {
    const CubeDirection& d = kCubeDirections[i];
    const double s = (d[0] * point.x() + d[1] * point.y()) + d[2] * point.z();
    const double error_bound = i < 3 ? 0 : 4 * kUnitRoundoff * taxicab3(point);
    if (!(s - error_bound <= static_cast<double>(max[i]) && s + error_bound >= static_cast<double>(min[i])))
      return false;
  }
  return true;
}

template struct SlabBounds<3, float>;
template struct SlabBounds<7, float>;
template struct SlabBounds<13, float>;
template struct SlabBounds<3, double>;
template struct SlabBounds<7, double>;
template struct SlabBounds<13, double>;

}  // namespace pcl_bv
