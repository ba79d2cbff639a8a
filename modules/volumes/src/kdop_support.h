// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Upper bounds of the support value of a k-DOP along any direction, by a linear program in three variables
// with a proven result.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "pcl_bv/volumes/kdop.h"

namespace pcl_bv::detail {

/// The slabs of a k-DOP relative to a nearby origin, so that large coordinates, such as UTM, cost no digits.
struct LocalSlabs {
  const KdopSet& set;
  Eigen::Vector3d origin;
  Eigen::Matrix3d basis_inverse;  ///< p = basis_inverse * s, with s the projections on the basis directions.
  std::vector<double> min, max;   ///< Bounds relative to the origin, correctly rounded.
};

/// The k-DOP must not be empty.
LocalSlabs local_slabs(const Kdop& kdop);

/// One side of a slab: the half-space sign * direction . p <= offset.
struct SlabSide {
  std::size_t slab;
  double sign;  ///< +1: the max side, -1: the min side.
};

/// The farthest corner along a direction, and the proof that it is the farthest: direction is the sum of
/// weights[i] * (outward normal of sides[i]), with weights >= 0.
struct FarthestCorner {
  std::array<SlabSide, 3> sides;
  Eigen::Vector3d weights;
  Eigen::Vector3d corner;  ///< Relative to the origin.
};

/// Finds the farthest corner by the dual simplex method, which starts at the farthest corner of the basis
/// slabs. After each step, all weights are >= 0, so the bound that they prove holds in spite of rounding
/// errors of the corner.
FarthestCorner farthest_corner(const LocalSlabs& slabs, const Eigen::Vector3d& direction);

/// Returns an upper bound, by exact arithmetic, of direction . (matrix * p) over all points p of the k-DOP,
/// which must not be empty. The bound is tight to a few units in the last place of the coordinates.
double support_up(const Kdop& kdop, const LocalSlabs& slabs, const Eigen::Matrix3d& matrix,
                  const Eigen::Vector3d& direction);

}  // namespace pcl_bv::detail
