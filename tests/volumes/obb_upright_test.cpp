// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Claims about the axes of upright boxes: the third is up, the first is the length, whose rotation is the
// yaw.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <vector>

#include "exact.h"
#include "obb_names.h"
#include "pcl_bv/volumes/obb.h"

namespace pcl_bv::detail {
namespace {

using namespace pcl_bv::testing;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double pi = 3.14159265358979323846;

std::vector<Vector3d> ups() {
  return {{0, 0, 1}, {0, 0, -1}, {0, 1, 0}, {0, -1, 0}, {1, 0, 0}, {-1, 0, 0}, {1, 2, 3}, {0.05, -0.02, 4}};
}

// A frame whose third column is up and whose first one has yaw 0.
Matrix3d frame_about(const Vector3d& up) {
  const Vector3d z = up.normalized();
  const Vector3d reference = std::abs(z.x()) > std::sqrt(0.5) ? Vector3d::UnitY() : Vector3d::UnitX();
  const Vector3d y = z.cross(reference).normalized();
  Matrix3d frame;
  frame << y.cross(z), y, z;
  return frame;
}

Matrix3d yawed(const Vector3d& up, double yaw) {
  return frame_about(up) * Eigen::AngleAxisd(yaw, Vector3d::UnitZ()).toRotationMatrix();
}

TEST(ObbUpright, AllNamesOfABoxGiveOneWithTheThirdAxisUpAndTheLongerOneFirst) {
  for (const Vector3d& up : ups()) {
    for (const double yaw : {0.0, 0.3, 1.2, pi / 2, -1.5, -0.7, 3.0}) {
      for (const Vector3d& half :
           {Vector3d(4, 2, 1), Vector3d(1, 2, 30), Vector3d(2, 1, 1.5), Vector3d(3, 0, 1), Vector3d(0, 0, 2),
            Vector3d(2, 2, 1), Vector3d(0, 0, 0)}) {
        const Obb box({5, -6, 7}, orthonormal_axes(yawed(up, yaw)), half);
        const Obb upright = box.upright(up);
        EXPECT_LE((upright.axis(2) - up.normalized()).norm(), 1e-14);
        EXPECT_GE(upright.half_extents()[0], upright.half_extents()[1]);
        EXPECT_EQ(upright.half_extents()[2], half[2]);
        EXPECT_NEAR(upright.axes().determinant(), 1, 1e-14) << "left-handed";
        EXPECT_GT(upright.yaw(), -pi / 2 + 1e-10);
        EXPECT_LT(upright.yaw(), pi / 2 + 1e-9);
        EXPECT_TRUE(upright.quaternion().toRotationMatrix().isApprox(upright.axes(), 1e-14));
        for (const Obb& name : all_names(box)) {
          EXPECT_EQ(name.upright(up), upright) << "up " << up.transpose() << ", yaw " << yaw;
          EXPECT_EQ(name.volume(), upright.volume());
          EXPECT_EQ(name.surface_area(), upright.surface_area());
        }
        EXPECT_EQ(upright.canonical(), box.canonical()) << "another box";
      }
    }
  }
}

TEST(ObbUpright, YawIsTheRotationOfTheFirstAxisAboutTheThird) {
  for (const Vector3d& up : ups()) {
    for (const double yaw : {0.0, 0.3, 1.2, pi / 2, 2.9, pi, -1.5, -0.7, -3.1}) {
      const Obb box({1, 2, 3}, orthonormal_axes(yawed(up, yaw)), {4, 2, 1});
      EXPECT_NEAR(std::remainder(box.yaw() - yaw, 2 * pi), 0, 1e-14) << up.transpose();
      EXPECT_NEAR(std::remainder(box.upright(up).yaw() - yaw, pi), 0, 1e-14) << up.transpose();
    }
  }
  EXPECT_EQ(Obb({0, 0, 0}, -yawed(Vector3d::UnitZ(), 0) * Vector3d(1, 1, -1).asDiagonal(), {1, 1, 1}).yaw(),
            pi)
      << "never -pi";
  EXPECT_TRUE(std::isnan(Obb().yaw()));
  EXPECT_TRUE(Obb().upright(Vector3d::UnitZ()).empty());
}

TEST(ObbUpright, NoiseTurnsNeitherSquareBasesNorSidesAlongTheFrame) {
  Random random(31);
  for (const Vector3d& up : ups()) {
    for (const Vector3d& half : {Vector3d(2, 2, 1), Vector3d(4, 2, 1), Vector3d(2, 2, 9)}) {
      for (const double yaw : {0.0, pi / 4, pi / 2}) {
        const Obb expected = Obb({1, 2, 3}, orthonormal_axes(yawed(up, yaw)), half).upright(up);
        for (int i = 0; i < 50; ++i) {
          const Matrix3d axes = orthonormal_axes(yawed(up, yaw) + 1e-13 * Matrix3d::Random());
          for (const Obb& name : all_names(Obb({1, 2, 3}, axes, half + random.vector(1e-13))))
            ASSERT_TRUE(name.upright(up).axes().isApprox(expected.axes(), 1e-11))
                << up.transpose() << ' ' << yaw;
        }
      }
    }
  }
}

TEST(ObbUpright, TheSquareBaseHasTheSmallerYaw) {
  for (const double yaw : {0.2, -0.2, 0.7, -0.7, 1.4, 2.5}) {
    const Obb box = Obb({0, 0, 0}, yawed(Vector3d::UnitZ(), yaw), {2, 2, 1}).upright(Vector3d::UnitZ());
    EXPECT_LE(std::abs(box.yaw()), pi / 4) << yaw;
    EXPECT_NEAR(std::remainder(box.yaw() - yaw, pi / 2), 0, 1e-14);
  }
  const Obb corner = Obb({0, 0, 0}, yawed(Vector3d::UnitZ(), -pi / 4), {2, 2, 1}).upright(Vector3d::UnitZ());
  EXPECT_NEAR(corner.yaw(), pi / 4, 1e-14);
}

TEST(ObbUpright, TheMergeOfUprightBoxesIsUpright) {
  Random random(32);
  for (const Vector3d& up : ups()) {
    const Vector3d third = orthonormal_axes(yawed(up, 0)).col(2);
    for (int i = 0; i < 40; ++i) {
      const auto box = [&](double yaw, const Vector3d& half) {
        Matrix3d axes = yawed(third, yaw);
        axes.col(2) = third;
        return Obb(random.vector(5), axes, half);
      };
      const Obb a = box(0.1 * i, {2, 1, 7}), b = box(1.0 + 0.3 * i, {3, 0.5, 0.2}), merged = a.merged(b);
      EXPECT_EQ(merged.axis(2), third);
      EXPECT_GE(merged.half_extents()[0], merged.half_extents()[1]);
      EXPECT_EQ(merged, merged.upright(third));
      EXPECT_EQ(merged, b.merged(a));
      for (const Obb& part : {a, b})
        for (const Vector3d& corner : part.corners())
          EXPECT_TRUE(merged.contains(corner));
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail
