// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Eigenvalues and eigenvectors of a symmetric 3 x 3 matrix.
#pragma once

#include <Eigen/Core>

namespace pcl_bv::detail {

struct SymmetricEigen {
  Eigen::Vector3d values;   ///< Eigenvalues, descending.
  Eigen::Matrix3d vectors;  ///< Eigenvectors as columns, orthonormal to about 1e-15, right-handed.
};

/// Computes eigenvalues and eigenvectors by Jacobi rotations. Uses only sums, products, quotients, powers of
/// two and square roots, so the bits are the same on every IEEE machine.
SymmetricEigen symmetric_eigen(const Eigen::Matrix3d& matrix);

}  // namespace pcl_bv::detail
