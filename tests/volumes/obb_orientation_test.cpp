// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Claims about the names of an oriented box's axes.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "exact.h"
#include "obb_names.h"
#include "obbs.h"
#include "pcl_bv/volumes/obb.h"

namespace pcl_bv::detail {
namespace {

using namespace pcl_bv::testing;
using Eigen::Matrix3d;
using Eigen::Vector3d;

TEST(ObbOrientation, CanonicalIsOneForAllNamesOfABox) {
  Random random(21);
  for (int i = 0; i < 50; ++i) {
    const Obb box = random_obb(random, scales()[0]);
    const Obb canonical = box.canonical();
    EXPECT_GE(canonical.half_extents()[0], canonical.half_extents()[1]);
    EXPECT_GE(canonical.half_extents()[1], canonical.half_extents()[2]);
    EXPECT_NEAR(canonical.axes().determinant(), 1, 1e-14);
    for (int k : {0, 1}) {
      Eigen::Index largest;
      canonical.axis(k).cwiseAbs().maxCoeff(&largest);
      EXPECT_GT(canonical.axis(k)[largest], 0);
    }
    ASSERT_EQ(all_names(box).size(), 24U);
    for (const Obb& name : all_names(box))
      EXPECT_EQ(name.canonical(), canonical);
  }
}

// Cubes, square bars and tiles, some at 45 degrees, whose sizes and axes differ by rounding.
TEST(ObbOrientation, CanonicalIsOneForAllNamesOfACubeOnItsEdge) {
  // Two axes have the same components but for a sign.
  const double s = std::sqrt(0.5);
  Matrix3d axes;
  axes << s, s, 0, s, -s, 0, 0, 0, 1;
  const Obb box({1, 2, 3}, axes, Vector3d::Ones());
  for (const Obb& name : all_names(box))
    EXPECT_EQ(name.canonical().axes(), box.canonical().axes());
}

TEST(ObbOrientation, CanonicalOfACubeHasTheAxesMoreAlongXFirst) {
  Random random(23);
  for (int i = 0; i < 50; ++i) {
    const Obb cube = Obb({0, 0, 0}, random_obb(random, scales()[0]).axes(), Vector3d::Ones()).canonical();
    EXPECT_GE(std::abs(cube.axis(0).x()), std::abs(cube.axis(1).x())) << "seed 23, " << i;
    EXPECT_GE(std::abs(cube.axis(1).x()), std::abs(cube.axis(2).x())) << "seed 23, " << i;
  }
}

TEST(ObbOrientation, CanonicalOfASquareOnItsCornerBeginsWithTheDiagonalUpward) {
  const double r = std::sqrt(0.5);
  Matrix3d axes;
  axes << r, r, 0, r, -r, 0, 0, 0, -1;
  for (const Obb& name : all_names(Obb({0, 0, 0}, axes, {2, 2, 1}))) {
    const Matrix3d canonical = name.canonical().axes();
    EXPECT_LE((canonical.col(0) - Vector3d(r, r, 0)).norm(), 1e-15);
    EXPECT_LE((canonical.col(1) - Vector3d(r, -r, 0)).norm(), 1e-15);
  }
}

TEST(ObbOrientation, CanonicalDoesNotFlipWhereSizesAgree) {
  Random random(22);
  for (const Vector3d& size : {Vector3d(1, 1, 1), Vector3d(2, 2, 1), Vector3d(1, 3, 3)}) {
    for (const int quarter : {0, 1, 2, 3}) {
      const Matrix3d turn =
          Eigen::AngleAxisd(quarter * 0.7853981633974483, Vector3d(quarter == 3, 0, quarter != 3))
              .toRotationMatrix();
      const Obb expected = Obb({1, 2, 3}, turn, size).canonical();
      for (int i = 0; i < 50; ++i) {
        const Matrix3d noise = orthonormal_axes(turn + 1e-13 * Matrix3d::Random());
        const Obb noisy({1, 2, 3}, noise, size + random.vector(1e-13));
        for (const Obb& name : all_names(noisy))
          ASSERT_TRUE(name.canonical().axes().isApprox(expected.axes(), 1e-11)) << i;
      }
    }
  }
}

TEST(ObbOrientation, OrientedAsIsTheNearestOfAll24) {
  Random random(23);
  for (int i = 0; i < 200; ++i) {
    const Obb box = random_obb(random, scales()[0]), previous = random_obb(random, scales()[0]);
    const auto likeness = [&](const Obb& b) { return (b.axes().transpose() * previous.axes()).trace(); };
    const Obb folded = box.oriented_as(previous);
    double most = -3;
    for (const Obb& name : all_names(box))
      most = std::max(most, likeness(name));
    EXPECT_NEAR(likeness(folded), most, 1e-12);
    EXPECT_EQ(folded.canonical(), box.canonical()) << "another box";
    EXPECT_EQ(folded.oriented_as(previous), folded);
  }
}

TEST(ObbOrientation, OrientedAsKeepsATurningBoxFromFlipping) {
  Obb previous({0, 0, 0}, Matrix3d::Identity(), {2, 1, 0.7});
  for (int step = 1; step <= 300; ++step) {
    const Matrix3d turn = Eigen::AngleAxisd(0.05 * step, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    const Vector3d size = step % 2 == 0 ? Vector3d(2, 1, 0.7) : Vector3d(2, 0.9, 0.95);  // order changes
    const Obb seen = Obb({0, 0, 0}, turn, size).canonical().oriented_as(previous);
    ASSERT_LT((seen.axes() - previous.axes()).norm(), 0.1) << step;
    EXPECT_TRUE(seen.half_extents().isApprox(size));
    previous = seen;
  }
}

TEST(ObbOrientation, OrthonormalAxesAreThatTo1e15) {
  Random random(24);
  for (int i = 0; i < 500; ++i) {
    Matrix3d rough = random.isometry(1).linear();
    if (i % 2 == 0) rough.col(1) = rough.col(0) + 1e-6 * rough.col(1);  // nearly parallel
    const Matrix3d axes = orthonormal_axes(rough * (i % 3 == 0 ? 1e-90 : 1e3));
    EXPECT_LE((axes.transpose() * axes - Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-15) << i;
    EXPECT_GT(axes.determinant(), 0.99);
    EXPECT_TRUE(axes.col(0).isApprox(rough.col(0).normalized(), 1e-14));
  }
}

}  // namespace
}  // namespace pcl_bv::detail
