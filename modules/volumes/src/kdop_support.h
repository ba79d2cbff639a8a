// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The slabs of a k-DOP relative to a nearby origin, and upper bounds of its support value along any
// direction, with a proof in exact arithmetic.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "dual_simplex.h"
#include "pcl_bv/volumes/kdop.h"

namespace pcl_bv::detail {

/// The slabs of a k-DOP relative to a nearby origin, so that large coordinates, such as UTM, cost no digits.
struct LocalSlabs {
  const KdopSet& set;
  Eigen::Vector3d origin;
  Eigen::Matrix3d basis_inverse;  ///< p = basis_inverse * s, with s the projections on the basis directions.
  SlabVector min, max;            ///< Bounds relative to the origin, correctly rounded.
};

/// The k-DOP must not be empty.
LocalSlabs local_slabs(const Kdop& kdop);

/// The support of a k-DOP, which must not be empty, and must outlive this object.
class KdopSupport {
 public:
  explicit KdopSupport(const Kdop& kdop);

  /// Returns a corner that is farthest along the direction, computed in plain double.
  Eigen::Vector3d corner(const Eigen::Vector3d& direction) const;

  /// Returns an upper bound, by exact arithmetic, of direction . (matrix * p) over all points p of the k-DOP.
  /// The bound is tight to a few units in the last place of the coordinates.
  double value_up(const Eigen::Matrix3d& matrix, const Eigen::Vector3d& direction) const;

 private:
  DualBasis farthest(const Eigen::Vector3d& direction) const;

  const Kdop& kdop_;
  Eigen::Vector3d origin_;
  // The max sides of all slabs, then the min sides, relative to the origin and multiplied by `scales_`.
  Normals normals_;
  std::vector<double> offsets_;
  SlabVector scales_;        // powers of two, by slab
  Eigen::Vector3d max_abs_;  // upper bound of |p_k|, by component
};

}  // namespace pcl_bv::detail
