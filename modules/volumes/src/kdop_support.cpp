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

// Returns an upper bound of each |p_k| over the intersection of the basis slabs. An entry of the inverse
// whose terms nearly cancel may have no correct digit. Its error is still below 1e-9 / |direction|, since the
// determinant of the normalised basis directions is at least 1e-6. The factor 1.01 covers all other errors.
Eigen::Vector3d coordinate_bound(const Kdop& kdop, const Eigen::Matrix3d& basis_inverse) {
  Eigen::Vector3d result = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    const std::size_t i = kdop.set()->basis()[k];
    const double largest = std::max(std::abs(kdop.min(i)), std::abs(kdop.max(i)));
    const double error_bound = 1e-9 / kdop.set()->direction(i).norm();
    result.array() += 1.01 * largest * (basis_inverse.col(k).array().abs() + error_bound);
  }
  return result;
}

}  // namespace

LocalSlabs::LocalSlabs(const Kdop& kdop)
    : kdop_(kdop), scales_(kdop.min().size()), offsets_(2 * kdop.size()) {
  Eigen::Matrix3d basis;
  Eigen::Vector3d low;
  for (int k = 0; k < 3; ++k) {
    const std::size_t i = set().basis()[k];
    basis.row(k) = set().direction(i).transpose();
    low[k] = kdop.min(i);
  }
  basis_inverse_ = basis.inverse();
  origin_ = basis_inverse_ * low;
  max_abs_ = coordinate_bound(kdop, basis_inverse_);
  normals_.reserve(offsets_.size());
  for (std::size_t i = 0; i < kdop.size(); ++i) {
    const Eigen::Vector3d& n = set().direction(i);
    scales_[i] = 1 / power_of_two(n);
    normals_.push_back(scales_[i] * n);
    Expansion shift;
    shift.add_dot(-n, origin_);
    offsets_[kdop.size() + i] = -scales_[i] * Expansion(shift).add(kdop.min(i)).value();
    offsets_[i] = scales_[i] * shift.add(kdop.max(i)).value();
  }
  for (std::size_t i = 0; i < kdop.size(); ++i)
    normals_.push_back(-normals_[i]);
}

DualBasis LocalSlabs::farthest(const Eigen::Vector3d& direction) const {
  const DualSimplex simplex{normals_, offsets_, direction};
  return simplex.solve(simplex.start(set().basis(), kdop_.size()), 0, 0x1p-44);
}

double LocalSlabs::support_up(const Eigen::Matrix3d& matrix, const Eigen::Vector3d& direction) const {
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
      residual[k].add_product(side == slab ? -weight : weight, set().direction(slab)[k]);
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    bound.add(multiply_up(residual[k].magnitude_up(), max_abs_[k]));
  }
  return bound.up();
}

}  // namespace pcl_bv::detail
