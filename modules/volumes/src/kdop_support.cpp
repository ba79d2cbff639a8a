// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "kdop_support.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/expansion.h"

namespace pcl_bv::detail {
namespace {

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
  result.min.resize(kdop.min().size());
  result.max.resize(kdop.max().size());
  for (std::size_t i = 0; i < set.size(); ++i) {
    Expansion shift;
    shift.add_dot(-set.direction(i), result.origin);
    result.min[i] = Expansion(shift).add(kdop.min(i)).value();
    result.max[i] = shift.add(kdop.max(i)).value();
  }
  return result;
}

KdopSupport::KdopSupport(const Kdop& kdop) : kdop_(kdop) {
  const LocalSlabs slabs = local_slabs(kdop);
  origin_ = slabs.origin;
  max_abs_ = coordinate_bound(kdop, slabs);
  const std::size_t count = kdop.size();
  normals_.reserve(2 * count);
  offsets_.resize(2 * count);
  scales_.resize(kdop.min().size());
  for (std::size_t i = 0; i < count; ++i) {
    scales_[i] = 1 / power_of_two(slabs.set.direction(i));
    offsets_[i] = slabs.max[i] * scales_[i];
    offsets_[count + i] = -slabs.min[i] * scales_[i];
    normals_.push_back(slabs.set.direction(i) * scales_[i]);
  }
  for (std::size_t i = 0; i < count; ++i)
    normals_.push_back(-normals_[i]);
}

DualBasis KdopSupport::farthest(const Eigen::Vector3d& direction) const {
  const DualSimplex simplex{normals_, offsets_, direction};
  return simplex.solve(simplex.start(kdop_.set()->basis(), kdop_.size()), 0, 0x1p-44);
}

Eigen::Vector3d KdopSupport::corner(const Eigen::Vector3d& direction) const {
  return origin_ + farthest(direction).corner;
}

double KdopSupport::value_up(const Eigen::Matrix3d& matrix, const Eigen::Vector3d& direction) const {
  const DualBasis basis = farthest(matrix.transpose() * direction);
  Expansion bound;
  std::array<Expansion, 3> residual;  // direction' * matrix - sum of weights * normals
  for (std::size_t k = 0; k < 3; ++k)
    residual[k].add_dot(matrix.col(k), direction);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t side = basis.sides[i], slab = side % kdop_.size();
    const double weight = basis.weights[i] * scales_[slab];
    bound.add_product(weight, side == slab ? kdop_.max(slab) : -kdop_.min(slab));
    for (std::size_t k = 0; k < 3; ++k) {
      residual[k].add_product(side == slab ? -weight : weight, kdop_.set()->direction(slab)[k]);
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    bound.add(multiply_up(residual[k].magnitude_up(), max_abs_[k]));
  }
  return bound.up();
}

}  // namespace pcl_bv::detail
