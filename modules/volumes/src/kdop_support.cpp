// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Weak duality proves the bounds. The polytope is N_i . p <= b_i for all i. Weights w_i >= 0 with sum w_i N_i
// = m prove m . p <= sum w_i b_i for every p of the polytope. The weights are computed in plain double. The
// sum of w_i b_i is computed exactly.
#include "kdop_support.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/expansion.h"

namespace pcl_bv::detail {
namespace {

Eigen::Vector3d outward(const LocalSlabs& slabs, const SlabSide& side) {
  return side.sign * slabs.set.direction(side.slab);
}

double offset(const LocalSlabs& slabs, const SlabSide& side) {
  return side.sign > 0 ? slabs.max[side.slab] : -slabs.min[side.slab];
}

// Stores in `side` the slab side that the point violates most. Returns false if the point violates no side by
// more than rounding errors.
bool most_violated(const LocalSlabs& slabs, const Eigen::Vector3d& point, SlabSide& side) {
  constexpr double rounding = 0x1p-44;
  const double extent = point.cwiseAbs().sum();
  double worst = 0;
  for (std::size_t i = 0; i < slabs.set.size(); ++i) {
    const Eigen::Vector3d& n = slabs.set.direction(i);
    const double s = n.dot(point);
    const double tolerance = rounding * (extent * n.cwiseAbs().maxCoeff());
    const double above = s - slabs.max[i], below = slabs.min[i] - s;
    const double excess = std::max(above, below) - tolerance;
    if (excess > worst * n.norm()) {
      worst = excess / n.norm();
      side = {i, above > below ? 1.0 : -1.0};
    }
  }
  return worst > 0;
}

// Replaces one of the three sides by `side` such that the weights stay >= 0. Returns false if no side can be
// replaced.
bool pivot(FarthestCorner& f, const Eigen::Matrix3d& normals_inverse, const Eigen::Vector3d& normal,
           const SlabSide& side) {
  const Eigen::Vector3d share = normals_inverse.transpose() * normal;
  int leaving = -1;
  double step = 0;
  for (int k = 0; k < 3; ++k) {
    if (share[k] <= 0x1p-40 * share.cwiseAbs().maxCoeff()) continue;
    if (leaving < 0 || f.weights[k] / share[k] < step) {
      leaving = k;
      step = f.weights[k] / share[k];
    }
  }
  if (leaving < 0) return false;
  f.weights = (f.weights - step * share).cwiseMax(0.0);
  f.weights[leaving] = step;
  f.sides[leaving] = side;
  return true;
}

FarthestCorner start(const LocalSlabs& slabs, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d weights = slabs.basis_inverse.transpose() * direction;
  FarthestCorner f{{}, weights.cwiseAbs(), {}};
  for (std::size_t k = 0; k < 3; ++k) {
    f.sides[k] = {slabs.set.basis()[k], weights[k] < 0 ? -1.0 : 1.0};
  }
  return f;
}

// Returns an upper bound of each |p_k| over the intersection of the basis slabs. An entry of the inverse that
// nearly cancels may have no correct digit, but its error is below 1e-9 / |direction|, since the determinant
// of the normalised basis directions is at least 1e-6. The factor 1.01 covers all other errors.
Eigen::Vector3d coordinate_bound(const Kdop& kdop, const LocalSlabs& slabs) {
  Eigen::Vector3d result = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    const std::size_t i = slabs.set.basis()[k];
    const double largest = std::max(std::abs(kdop.min(i)), std::abs(kdop.max(i)));
    const double error_bound = 1e-9 / slabs.set.direction(i).norm();
    result.array() += 1.01 * largest * (slabs.basis_inverse.col(k).array().abs() + error_bound);
  }
  return result;
}

}  // namespace

LocalSlabs local_slabs(const Kdop& kdop) {
  const KdopSet& set = *kdop.set();
  Eigen::Matrix3d basis;
  Eigen::Vector3d low;
  for (int k = 0; k < 3; ++k) {
    const std::size_t i = set.basis()[k];
    basis.row(k) = set.direction(i).transpose();
    low[k] = kdop.min(i);
  }
  LocalSlabs result{set, {}, basis.inverse(), {}, {}};
  result.origin = result.basis_inverse * low;
  for (std::size_t i = 0; i < set.size(); ++i) {
    Expansion shift;
    shift.add_dot(-set.direction(i), result.origin);
    result.min.push_back(Expansion(shift).add(kdop.min(i)).value());
    result.max.push_back(Expansion(shift).add(kdop.max(i)).value());
  }
  return result;
}

FarthestCorner farthest_corner(const LocalSlabs& slabs, const Eigen::Vector3d& direction) {
  FarthestCorner f = start(slabs, direction);
  // 360,000 random cases took at most 6 steps. The limit prevents an infinite loop by cycling. If the limit
  // is reached, the bound is valid but less tight.
  const std::size_t limit = 8 * slabs.set.size();
  for (std::size_t step = 0; step <= limit; ++step) {
    Eigen::Matrix3d normals;
    Eigen::Vector3d offsets;
    for (int k = 0; k < 3; ++k) {
      const SlabSide& side = f.sides[k];
      normals.row(k) = outward(slabs, side).transpose();
      offsets[k] = offset(slabs, side);
    }
    const Eigen::Matrix3d inverse = normals.inverse();
    f.corner = inverse * offsets;
    SlabSide side{};
    if (!most_violated(slabs, f.corner, side) || !pivot(f, inverse, outward(slabs, side), side)) break;
  }
  return f;
}

double support_up(const Kdop& kdop, const LocalSlabs& slabs, const Eigen::Matrix3d& matrix,
                  const Eigen::Vector3d& direction) {
  const FarthestCorner f = farthest_corner(slabs, matrix.transpose() * direction);
  Expansion bound;
  std::array<Expansion, 3> residual;  // direction' * matrix - sum of weights * normals
  for (std::size_t k = 0; k < 3; ++k)
    residual[k].add_dot(matrix.col(k), direction);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [slab, sign] = f.sides[i];
    const double weight = f.weights[i];
    bound.add_product(weight, sign > 0 ? kdop.max(slab) : -kdop.min(slab));
    for (std::size_t k = 0; k < 3; ++k) {
      residual[k].add_product(-sign * weight, slabs.set.direction(slab)[k]);
    }
  }
  const Eigen::Vector3d coordinates = coordinate_bound(kdop, slabs);
  for (std::size_t k = 0; k < 3; ++k) {
    bound.add(multiply_up(residual[k].magnitude_up(), coordinates[k]));
  }
  return bound.up();
}

}  // namespace pcl_bv::detail
