// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// How far a k-DOP reaches along any direction: a linear program in three variables whose answer is proven.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "pcl_bv/volumes/kdop.h"

namespace pcl_bv::volumes_internal {

/// The slabs seen from a point near them, so that coordinates of UTM size do not eat up the digits.
struct LocalSlabs {
  const KdopSet& set;
  Eigen::Vector3d origin;
  Eigen::Matrix3d basis_inverse;  ///< p = basis_inverse * s for s = projections on the basis directions.
  std::vector<double> min, max;   ///< Relative to the origin, correctly rounded.
};

/// For a k-DOP that is not empty.
LocalSlabs local_slabs(const Kdop& kdop);

/// One side of a slab: the half-space sign * direction . p <= offset.
struct SlabSide {
  std::size_t slab;
  double sign;  ///< +1: the max side, -1: the min side.
};

/// A corner and why it is the farthest: direction = sum of weights[i] * (outward normal of sides[i]), weights
/// >= 0.
struct Farthest {
  std::array<SlabSide, 3> sides;
  Eigen::Vector3d weights;
  Eigen::Vector3d corner;  ///< Relative to the origin.
};

/// The dual simplex method, from the corner of the basis slabs that is farthest along the direction. Each
/// step keeps the weights sound, so the bound that they prove holds whatever rounding does to the corner.
Farthest farthest(const LocalSlabs& slabs, const Eigen::Vector3d& direction);

/// An upper bound, by exact arithmetic, of direction . (matrix * p) over the p of a k-DOP that is not empty;
/// tight to a few units in the last place of the coordinates.
double support_up(const Kdop& kdop, const LocalSlabs& slabs, const Eigen::Matrix3d& matrix,
                  const Eigen::Vector3d& direction);

}  // namespace pcl_bv::volumes_internal
