// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>

namespace pcl_bv {

struct SymmetricEigen {
  Eigen::Vector3d values;   ///< Descending.
  Eigen::Matrix3d vectors;  ///< Columns, orthonormal to some 1e-15, right-handed.
};

/// Jacobi's rotations: only sums, products, quotients and roots, so the bits are those of every IEEE machine.
SymmetricEigen symmetric_eigen(const Eigen::Matrix3d& matrix);

}  // namespace pcl_bv
