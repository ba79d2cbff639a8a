// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Bounds of tree nodes, namely minimum and maximum projections on the first directions of kCubeDirections.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "pcl_bv/volumes/any_volume.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// A k-DOP with fixed directions. It is the set of all points p with min[i] <= d . p <= max[i] for the first
/// N directions d of kCubeDirections. N = 3 is a box, 7 a 14-DOP and 13 a 26-DOP (Klosowski et al. 1998).
///
/// T is float or double. Bounds are rounded outward, so the bounded object stays inside by exact arithmetic.
/// Frame and unit are those of the bounded object. Unlike Kdop it has no pointer to a direction set, so
/// overlaps() takes only about 5 ns.
///
/// The empty bounds (the identity of merge()) have min = +infinity and max = -infinity.
template <std::size_t N, typename T>
struct SlabBounds {
  static_assert(N == 3 || N == 7 || N == 13);

  std::array<T, N> min, max;

  /// Makes the empty bounds.
  SlabBounds() {
    min.fill(std::numeric_limits<T>::infinity());
    max.fill(-std::numeric_limits<T>::infinity());
  }

  /// Makes the tightest bounds of a box.
  explicit SlabBounds(const Aabb& box);

  /// Makes bounds of a volume, by exact arithmetic on its definition. They are empty for an empty volume.
  ///
  /// The bounds are tight to a few units in the last place of the coordinates and 1e-12 of the size. For a
  /// k-DOP or hull they are tight to 2^-46 of the weights that prove the bound. They are infinite where the
  /// planes of a Hull prove no bound. Takes about 1 us, or 10 to 100 us for a k-DOP or hull, because each of
  /// its bounds is a linear program.
  explicit SlabBounds(const AnyVolume& volume);

  /// Returns whether the bounds are empty.
  bool empty() const { return !(min[0] <= max[0]); }

  /// Extends the bounds to hold the other bounds. The operation is exact, commutative and associative.
  SlabBounds& merge(const SlabBounds& other) {
    for (std::size_t i = 0; i < N; ++i) {
      min[i] = std::min(min[i], other.min[i]);
      max[i] = std::max(max[i], other.max[i]);
    }
    return *this;
  }

  /// Returns whether each slab overlaps that of the other bounds, by exact comparison. If it returns false,
  /// no point is in both bounds. Returns false if either is empty.
  bool overlaps(const SlabBounds& other) const {
    bool all = true;
    for (std::size_t i = 0; i < N; ++i)
      all = all && min[i] <= other.max[i] && other.min[i] <= max[i];
    return all;
  }

  /// Returns whether the point may be inside. Points outside are accepted only within the rounding error of a
  /// sum of three doubles. Returns false for empty bounds and for a point with a NaN.
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
