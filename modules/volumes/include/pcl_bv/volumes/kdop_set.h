// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "pcl_bv/numeric/directions.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// An immutable list of the directions of a k-DOP, one per slab. k is twice the number of directions.
/// Directions may have any length. The built-in directions have components 0 and +-1 and are not normalised,
/// so that projections need no multiplication. See Klosowski et al. 1998 and Karlsson, Winberg and Larsson
/// 2010, section 2.
class KdopSet {
 public:
  static constexpr std::size_t min_size = 3;
  static constexpr std::size_t max_size = 49;

  /// Makes a set of your own directions. Throws std::invalid_argument unless there are 3 to 49 directions,
  /// all finite, each with a largest component from 1e-30 to 1e30 in magnitude. Also throws unless the
  /// directions span space, that is, unless three of them, normalised, have a determinant of at least 1e-6 in
  /// magnitude.
  explicit KdopSet(std::vector<Eigen::Vector3d> directions);

  /// Returns a built-in set, a subset of kCubeDirections. The pointer owns nothing, so copying the pointer
  /// changes no atomic reference count.
  static const std::shared_ptr<const KdopSet>& of(DirectionSet set);

  static const std::shared_ptr<const KdopSet>& dop6() { return of(DirectionSet::dop6); }
  static const std::shared_ptr<const KdopSet>& dop14() { return of(DirectionSet::dop14); }
  static const std::shared_ptr<const KdopSet>& dop18() { return of(DirectionSet::dop18); }
  static const std::shared_ptr<const KdopSet>& dop26() { return of(DirectionSet::dop26); }

  std::size_t size() const { return directions_.size(); }  ///< Number of directions: half of k.
  const Eigen::Vector3d& direction(std::size_t i) const { return directions_[i]; }  ///< Not normalised.

  /// Returns the indices of three linearly independent, well-conditioned directions. In the built-in sets,
  /// they are 0, 1 and 2.
  const std::array<std::size_t, 3>& basis() const { return basis_; }

 private:
  std::vector<Eigen::Vector3d> directions_;
  std::array<std::size_t, 3> basis_;
};

/// Returns whether both sets have the same directions in the same order.
bool operator==(const KdopSet& a, const KdopSet& b);
inline bool operator!=(const KdopSet& a, const KdopSet& b) {
  return !(a == b);
}

}  // namespace pcl_bv
