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

/// An immutable list of directions, one per slab, of any length each (the built-in ones have components
/// 0 and +-1, un-normalised, so that projections need no multiplication). k is twice their number. Klosowski
/// et al. 1998; Karlsson et al. 2010, section 2.
class KdopSet {
 public:
  static constexpr std::size_t min_size = 3;
  static constexpr std::size_t max_size = 49;

  /// Throws std::invalid_argument unless there are 3 to 49 directions, all finite, each with its largest
  /// component between 1e-30 and 1e30 in magnitude, which span 3-space (unit determinant of some three of at
  /// least 1e-6).
  explicit KdopSet(std::vector<Eigen::Vector3d> directions);

  /// The built-in one along the set's part of kCubeDirections. Copies of these pointers count no references,
  /// so cost no atomics.
  static const std::shared_ptr<const KdopSet>& of(DirectionSet set);

  static const std::shared_ptr<const KdopSet>& dop6() { return of(DirectionSet::dop6); }
  static const std::shared_ptr<const KdopSet>& dop14() { return of(DirectionSet::dop14); }
  static const std::shared_ptr<const KdopSet>& dop18() { return of(DirectionSet::dop18); }
  static const std::shared_ptr<const KdopSet>& dop26() { return of(DirectionSet::dop26); }

  std::size_t size() const { return directions_.size(); }
  const Eigen::Vector3d& direction(std::size_t i) const { return directions_[i]; }

  /// Three well-conditioned independent directions: 0, 1, 2 in the built-in sets.
  const std::array<std::size_t, 3>& basis() const { return basis_; }

 private:
  std::vector<Eigen::Vector3d> directions_;
  std::array<std::size_t, 3> basis_;
};

/// The same directions in the same order.
bool operator==(const KdopSet& a, const KdopSet& b);
inline bool operator!=(const KdopSet& a, const KdopSet& b) {
  return !(a == b);
}

}  // namespace pcl_bv
