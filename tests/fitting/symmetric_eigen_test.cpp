// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "box/symmetric_eigen.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <vector>

namespace pcl_bv::detail {
namespace {

Eigen::Matrix3d symmetric(double xx, double yy, double zz, double xy, double xz, double yz) {
  return Eigen::Matrix3d{{xx, xy, xz}, {xy, yy, yz}, {xz, yz, zz}};
}

// Equal numbers on the diagonal with and without zeros beside it, and ones, which a comparison could mix up.
const std::vector<Eigen::Matrix3d>& matrices() {
  static const std::vector<Eigen::Matrix3d> all = {symmetric(1, 1, 1, 0, 0, 0),
                                                   symmetric(2, 2, 2, 0, 1, 0),
                                                   symmetric(2, 2, 2, 1, 0, 0),
                                                   symmetric(2, 2, 2, 0, 0, 1),
                                                   symmetric(2, 3, 5, 1, 1, 1),
                                                   symmetric(2, 2, 2, 1, 1, 1),
                                                   symmetric(0, 0, 0, 1, 1, 1),
                                                   symmetric(1, 2, 3, 0, 0, 0),
                                                   symmetric(3, 1, 2, 0, 0, 0),
                                                   symmetric(5, 1, 1, -2, 0, 0),
                                                   symmetric(1, 1e-6, 1e-12, 1e-4, 0, 1e-9),
                                                   symmetric(0, 0, 0, 0, 0, 0),
                                                   symmetric(1, 1, 0, 1, 1e-163, 2e-163),
                                                   symmetric(1, 1, 0, 1, 1e-170, 2e-170),
                                                   symmetric(4, 1, 9, 0.5, -0.25, 0.125)};
  return all;
}

TEST(SymmetricEigen, VectorsAreThoseOfTheValues) {
  for (const Eigen::Matrix3d& m : matrices()) {
    const SymmetricEigen eigen = symmetric_eigen(m);
    for (int k = 0; k < 3; ++k)
      EXPECT_LE((m * eigen.vectors.col(k) - eigen.values[k] * eigen.vectors.col(k)).norm(), 1e-15 * m.norm())
          << m;
  }
}

TEST(SymmetricEigen, ValuesDecrease) {
  for (const Eigen::Matrix3d& m : matrices()) {
    const SymmetricEigen eigen = symmetric_eigen(m);
    EXPECT_TRUE(eigen.values[0] >= eigen.values[1] && eigen.values[1] >= eigen.values[2]) << m;
    EXPECT_NEAR(eigen.values[0] + eigen.values[1] + eigen.values[2], m.trace(), 1e-15 * m.norm()) << m;
  }
}

TEST(SymmetricEigen, ScaleWithTheMatrix) {
  for (const Eigen::Matrix3d& m : matrices()) {
    const SymmetricEigen eigen = symmetric_eigen(m);
    for (const double scale : {0x1p1000, 0x1p-500}) {
      const SymmetricEigen scaled = symmetric_eigen(scale * m);
      EXPECT_LE((scaled.vectors - eigen.vectors).norm(), 1e-15) << scale << '\n' << m;
      EXPECT_LE((scaled.values / scale - eigen.values).norm(), 1e-15 * m.norm()) << scale << '\n' << m;
    }
  }
}

TEST(SymmetricEigen, OfEqualValuesTheAxesKeepTheirOrder) {
  EXPECT_EQ(symmetric_eigen(Eigen::Matrix3d::Identity()).vectors, Eigen::Matrix3d::Identity());
}

TEST(SymmetricEigen, VectorsAreARightHandedFrame) {
  for (const Eigen::Matrix3d& m : matrices()) {
    const Eigen::Matrix3d v = symmetric_eigen(m).vectors;
    EXPECT_LE((v.transpose() * v - Eigen::Matrix3d::Identity()).norm(), 1e-15) << m;
    EXPECT_GT(v.determinant(), 0) << m;
  }
}

}  // namespace
}  // namespace pcl_bv::detail
