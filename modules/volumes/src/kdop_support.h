// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The slabs of a k-DOP relative to a nearby origin, and proven upper bounds of the k-DOP's support value
// along any direction.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "dual_simplex.h"
#include "pcl_bv/volumes/kdop.h"

namespace pcl_bv::detail {

/// The slabs of a k-DOP relative to a nearby origin, so that large coordinates, such as UTM, cost no digits.
/// The k-DOP must not be empty, and must outlive this object.
class LocalSlabs {
 public:
  explicit LocalSlabs(const Kdop& kdop);

  const KdopSet& set() const { return *kdop_.set(); }
  const Eigen::Vector3d& origin() const { return origin_; }

  /// The matrix with p = basis_inverse() * s, where s are the projections of p on the basis directions.
  const Eigen::Matrix3d& basis_inverse() const { return basis_inverse_; }

  /// Bounds relative to the origin, rounded.
  double min(std::size_t i) const { return -offsets_[kdop_.size() + i] / scales_[i]; }
  double max(std::size_t i) const { return offsets_[i] / scales_[i]; }

  /// Returns a corner that is farthest along the direction, relative to the origin. Computed in plain double.
  Eigen::Vector3d corner(const Eigen::Vector3d& direction) const { return farthest(direction).corner; }

  /// Returns a proven upper bound of direction . (matrix * p) over all points p of the k-DOP. The bound is
  /// tight to a few units in the last place of the coordinates.
  double support_up(const Eigen::Matrix3d& matrix, const Eigen::Vector3d& direction) const;

 private:
  DualBasis farthest(const Eigen::Vector3d& direction) const;

  const Kdop& kdop_;
  Eigen::Vector3d origin_;
  Eigen::Matrix3d basis_inverse_;
  Eigen::Vector3d max_abs_;      // upper bound of |p_k|, by component
  SlabVector scales_;            // powers of two, by slab
  Normals normals_;              // of max sides, then of min sides, times `scales_`
  std::vector<double> offsets_;  // in the same order and scale, relative to the origin
};

}  // namespace pcl_bv::detail
