// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Bounds of what moving a volume may lose: internal, and what enclosure rests on.
#include "bounds.h"

#include <gtest/gtest.h>

#include "exact.h"

namespace pcl_bv {
namespace {

using namespace pcl_bv::testing;
using namespace pcl_bv::detail;
using Eigen::Vector3d;

bool is_within(double bound, const ExactPoint& difference) {
  Rational squared = 0;
  for (const Rational& d : difference)
    squared += d * d;
  return bound >= 0 && squared <= Rational(bound) * Rational(bound);
}

TEST(Motion, DifferenceIsAtMostItsBound) {
  Random random(41);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Isometry3d turn = random.isometry(0);
    const Vector3d v = random.vector(1);
    // Once nearly equal, once opposed along one axis, where the last bit decides.
    const Vector3d w = i % 2 == 0 ? Vector3d(turn.linear() * v / 1.5) : Vector3d(random.uniform(1, 2), 0, 0);
    const Eigen::Matrix3d m = i % 2 == 0 ? turn.linear() : Eigen::Matrix3d(-turn.linear() * 0x1p-55);
    ExactPoint difference;
    for (int k = 0; k < 3; ++k)
      difference[static_cast<std::size_t>(k)] =
          dot(m.row(k).transpose(), exact(v)) - Rational(1.5) * Rational(w[k]);
    EXPECT_TRUE(is_within(difference_up(m, v, 1.5, w), difference)) << i;
  }
}

TEST(Motion, APointIsAtMostItsErrorFromItsExactImage) {
  Random random(42);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Isometry3d transform = random.isometry(10);
    const Vector3d p = random.vector(3);
    const PointWithError moved = transform_point(transform, p);
    ExactPoint difference = image(transform, exact(p));
    for (std::size_t k = 0; k < 3; ++k)
      difference[k] -= exact(moved.point)[k];
    EXPECT_TRUE(is_within(moved.error, difference)) << i;
    EXPECT_LT(moved.error, 1e-13) << i;
  }
}

TEST(Motion, StretchIsThatOfAScaledRotation) {
  EXPECT_EQ(matrix_norm_up(Eigen::Matrix3d::Identity()), 1);
  EXPECT_EQ(matrix_norm_up(-4 * Eigen::Matrix3d::Identity()), 4);
  EXPECT_EQ(matrix_norm_up(Vector3d(2, -3, 0.5).asDiagonal().toDenseMatrix()), 3);
  EXPECT_NEAR(matrix_norm_up(Random(43).isometry(0).linear()), 1, 1e-15);
  Eigen::Matrix3d shear = Eigen::Matrix3d::Identity();
  shear(0, 2) = -1;  // greatest singular value: the golden ratio
  EXPECT_GE(matrix_norm_up(shear), 1.618033988749894);
  EXPECT_LT(matrix_norm_up(shear), 1.8);
}

}  // namespace
}  // namespace pcl_bv
