// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/kernels/transform_points.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "clouds.h"
#include "pcl_bv/points/point_groups.h"

namespace pcl_bv::detail {
namespace {

Eigen::Isometry3d mounting() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translate(Eigen::Vector3d(1.5, -0.25, 0.75));
  pose.rotate(Eigen::AngleAxisd(2.1, Eigen::Vector3d(0.2, -0.3, 0.9).normalized()));
  return pose;
}

RigidTransform rows_of(const Eigen::Isometry3d& pose) {
  RigidTransform rows{};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 4; ++k)
      rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)] = pose(i, k);
  return rows;
}

template <typename T>
std::vector<T> transformed(Isa isa, const PointView& points, const RigidTransform& rows) {
  std::vector<T> xyz(3 * points.count);
  transform_points(isa, points, rows, reinterpret_cast<std::byte*>(xyz.data()));
  return xyz;
}

template <typename T>
void expect_as_eigen(double tolerance) {
  const test::TestCloud<T> cloud = test::gaussian<T>(5003, 7);
  const std::vector<T> found = transformed<T>(Isa::scalar, cloud.view(), rows_of(mounting()));
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d p(cloud.xyz[3 * i], cloud.xyz[3 * i + 1], cloud.xyz[3 * i + 2]);
    const Eigen::Vector3d expected = mounting() * p;
    const Eigen::Vector3d error =
        Eigen::Vector3d(found[3 * i], found[3 * i + 1], found[3 * i + 2]) - expected;
    ASSERT_LT(error.norm(), tolerance * (2 + p.norm())) << i;
  }
}

TEST(TransformPoints, GivesThePositionsOfEigensIsometry) {
  expect_as_eigen<float>(3e-7);
  expect_as_eigen<double>(1e-15);
}

template <typename T>
void expect_the_same_bits() {
  for (const std::size_t n : {0, 1, 3, 7, 8, 15, 16, 17, 31, 33, 100, 5003}) {
    const test::TestCloud<T> cloud = test::gaussian<T>(n, n + 1);
    const std::vector<T> expected = transformed<T>(Isa::scalar, cloud.view(), rows_of(mounting()));
    const test::Records<T> wide(cloud, 32, 4), padded(cloud, 4 * sizeof(T)), narrow(cloud, 24 + 3 * sizeof(T), 24);
    std::vector<std::int32_t> all(n);
    std::iota(all.begin(), all.end(), 0);
    const PointView listed = cloud.view().subset(all);
    const PointGroups groups(cloud.view());
    for (const Isa isa : usable_isas()) {
      SCOPED_TRACE(std::string(isa_name(isa)) + ", " + std::to_string(n));
      for (const PointView& view :
           {cloud.view(), wide.view(), padded.view(), narrow.view(), listed, groups.view()})
        EXPECT_EQ(transformed<T>(isa, view, rows_of(mounting())), expected);
    }
  }
}

TEST(TransformPoints, GivesTheSameBitsOnEverySetAndInEveryLayout) {
  expect_the_same_bits<float>();
  expect_the_same_bits<double>();
}

TEST(TransformPoints, MakesPointsWithoutReturnAndInvalidPointsNaN) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN(),
                  kInfinity = std::numeric_limits<float>::infinity(),
                  kMax = std::numeric_limits<float>::max();
  std::vector<float> xyz{0, 0, 0, kNaN, 1, 2, 3, kInfinity, 4, 0, -0.F, 0, kMax, kMax, -kMax, 1, 2, 3};
  for (int i = 0; i < 20; ++i)
    xyz.insert(xyz.end(), {1, 2, 3});
  const std::size_t n = xyz.size() / 3;
  for (const Isa isa : usable_isas()) {
    const std::vector<float> found =
        transformed<float>(isa, PointView::of(xyz.data(), 3 * sizeof(float), n), rows_of(mounting()));
    for (std::size_t i = 0; i < 3 * n; ++i)
      EXPECT_EQ(std::isnan(found[i]), i < 15) << isa_name(isa) << ' ' << i;
  }
}

TEST(TransformPoints, ByTheIdentityChangesNoPoint) {
  const test::TestCloud<float> cloud = test::gaussian<float>(100, 3);
  for (const Isa isa : usable_isas())
    EXPECT_EQ(transformed<float>(isa, cloud.view(), rows_of(Eigen::Isometry3d::Identity())), cloud.xyz)
        << isa_name(isa);
}

}  // namespace
}  // namespace pcl_bv::detail
