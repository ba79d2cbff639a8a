// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Bounds of tree nodes: how far something reaches along the first directions of the cube.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "pcl_bv/volumes/any_volume.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// All p with min[i] <= d . p <= max[i] for the first N directions d of kCubeDirections: 3 are a box, 7 a
/// 14-DOP, 13 a 26-DOP (Klosowski et al. 1998). In the frame and unit of what it bounds. T is float or
/// double; bounds are rounded outward, so what was bounded stays inside by exact arithmetic. Plain numbers
/// without a pointer to their directions, as Kdop has: two of them are compared in some 5 ns.
///
/// Empty (the identity of merge): all min are +infinity, all max -infinity.
template <std::size_t N, typename T>
struct SlabBounds {
  static_assert(N == 3 || N == 7 || N == 13);

  std::array<T, N> min, max;

  SlabBounds() {
    min.fill(std::numeric_limits<T>::infinity());
    max.fill(-std::numeric_limits<T>::infinity());
  }

  /// The tightest bounds of a box.
  explicit SlabBounds(const Aabb& box);

  /// Bounds of a volume, by exact arithmetic on its definition, tight to some units in the last place of its
  /// coordinates and 1e-12 of its size (of planes to 2^-46 of the weights that prove a bound). Infinite where
  /// a Hull's planes enclose nothing. Empty for an empty one. About 1 us; a k-DOP or hull, whose bounds are
  /// linear programs, 10 to 100 us.
  explicit SlabBounds(const AnyVolume& volume);

  bool empty() const { return !(min[0] <= max[0]); }

  /// Grows to hold the other: exact, commutative and associative.
  SlabBounds& merge(const SlabBounds& other) {
    for (std::size_t i = 0; i < N; ++i) {
      min[i] = std::min(min[i], other.min[i]);
      max[i] = std::max(max[i], other.max[i]);
    }
    return *this;
  }

  /// Whether all slabs overlap those of the other: exact comparison. False proves that no point is in both.
  /// False if either is empty.
  bool overlaps(const SlabBounds& other) const {
    bool all = true;
    for (std::size_t i = 0; i < N; ++i)
      all = all && min[i] <= other.max[i] && other.min[i] <= max[i];
    return all;
  }

  /// Whether the point may be inside: errs only towards true, by the rounding of a sum of three doubles.
  /// False for empty bounds and a point with a NaN.
  bool contains(const Eigen::Vector3d& point) const;
};

template <std::size_t N, typename T>
bool operator==(const SlabBounds<N, T>& a, const SlabBounds<N, T>& b) {
  return a.min == b.min && a.max == b.max;
}

extern template struct SlabBounds<3, float>;
extern template struct SlabBounds<7, float>;
extern template struct SlabBounds<13, float>;
extern template struct SlabBounds<3, double>;
extern template struct SlabBounds<7, double>;
extern template struct SlabBounds<13, double>;

}  // namespace pcl_bv
