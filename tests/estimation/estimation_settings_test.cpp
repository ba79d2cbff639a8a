// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What else can be asked of the classes: proofs, own directions, PCL's pointers; and which point types they
// take.

#include <gtest/gtest.h>
#include <pcl/point_types.h>

#include <atomic>
#include <stdexcept>
#include <thread>

#include "pcl_bv/estimation/bounding_volume_estimation.h"
#include "pcl_bv/estimation/fit_cloud.h"
#include "random_cloud.h"

namespace pcl_bv::detail {
namespace {

TEST(SphereEstimation, TheCertificateOfTheSmallestSphereComesWithIt) {
  const auto cloud = random_cloud<pcl::PointXYZI>(1000, 4);
  SphereEstimation<pcl::PointXYZI> estimation;
  estimation.setInputCloud(cloud);
  const auto odd = std::make_shared<pcl::Indices>();
  for (int i = 1; i < 1000; i += 2)
    odd->push_back(i);
  for (const pcl::IndicesPtr& indices : {pcl::IndicesPtr(), pcl::IndicesPtr(odd)}) {
    estimation.setIndices(indices);
    Sphere sphere, expected;
    SphereCertificate certificate;
    EXPECT_EQ(estimation.compute(sphere, certificate).used, indices ? 500U : 1000U);
    estimation.compute(expected);
    EXPECT_EQ(sphere, expected);
    EXPECT_LE(sphere.radius(), certificate.lower_bound * (1 + 1e-12));
    ASSERT_GE(certificate.support_size, 2);
    for (int i = 0; i < certificate.support_size; ++i) {
      const std::size_t support = certificate.support[static_cast<std::size_t>(i)];
      const Eigen::Vector3d p = (*cloud)[support].getVector3fMap().cast<double>();
      EXPECT_NEAR((p - sphere.center()).norm(), sphere.radius(), 1e-9) << "point " << support;
      EXPECT_TRUE(!indices || support % 2 == 1) << "numbers are the cloud's";
    }
  }
}

TEST(SphereEstimation, OnlyTheSmallestSphereHasACertificate) {
  SphereEstimation<pcl::PointXYZ> estimation;
  Sphere sphere;
  SphereCertificate certificate;
  EXPECT_THROW(estimation.compute(sphere, certificate), std::logic_error) << "no cloud";
  estimation.setInputCloud(random_cloud<pcl::PointXYZ>(10, 4));
  estimation.setMethod(SphereMethod::epos98);
  EXPECT_THROW(estimation.compute(sphere, certificate), std::invalid_argument);
  EXPECT_TRUE(sphere.empty());
}

TEST(KdopEstimation, FitsAlongDirectionsOfYourOwn) {
  const auto cloud = random_cloud<pcl::PointXYZ>(500, 11);
  const auto directions = std::make_shared<const KdopSet>(
      std::vector<Eigen::Vector3d>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {3, 4, 0}, {-1, 2, 5}});
  KdopEstimation<pcl::PointXYZ, 14> estimation;
  EXPECT_EQ(estimation.getDirections(), KdopSet::dop14());
  estimation.setDirections(directions);
  EXPECT_EQ(estimation.getDirections(), directions);
  estimation.setInputCloud(cloud);
  Kdop kdop, with_points;
  SlabPoints touching;
  const auto expected = fit_kdop_with_contacts(*cloud, directions);
  estimation.compute(kdop);
  EXPECT_EQ(kdop, *expected);
  estimation.compute(with_points, touching);
  EXPECT_EQ(with_points, *expected);
  EXPECT_EQ(touching.max, expected.contacts.max);
  std::vector<Kdop> kdops;
  estimation.compute(std::vector<pcl::PointIndices>(2), kdops);
  EXPECT_EQ(kdops[1].set(), directions);
}

TEST(KdopEstimation, NullDirectionsAreRefusedAndChangeNothing) {
  KdopEstimation<pcl::PointXYZ> estimation;
  EXPECT_THROW(estimation.setDirections(nullptr), std::invalid_argument);
  EXPECT_EQ(estimation.getDirections(), KdopSet::dop26());
}

TEST(Estimation, HasPclsPointers) {
  const AabbEstimation<pcl::PointXYZ>::Ptr aabb(new AabbEstimation<pcl::PointXYZ>);
  const BoundingVolumeEstimation<pcl::PointXYZ, Aabb>::ConstPtr base = aabb;
  aabb->setInputCloud(random_cloud<pcl::PointXYZ>(10, 1));
  Aabb box;
  EXPECT_EQ(base->compute(box).used, 10U);
  const auto names_itself = [](auto estimation) {
    using Class = decltype(estimation);
    return std::is_same_v<typename Class::Ptr, pcl::shared_ptr<Class>> &&
           std::is_same_v<typename Class::ConstPtr, pcl::shared_ptr<const Class>>;
  };
  EXPECT_TRUE(names_itself(AabbEstimation<pcl::PointXYZ>()));
  EXPECT_TRUE(names_itself(KdopEstimation<pcl::PointXYZ, 18>()));
  EXPECT_TRUE(names_itself(SphereEstimation<pcl::PointXYZ>()));
  EXPECT_TRUE(names_itself(ObbEstimation<pcl::PointXYZ>()));
  EXPECT_TRUE(names_itself(HullEstimation<pcl::PointXYZ>()));
  EXPECT_TRUE(names_itself(CylinderEstimation<pcl::PointXYZ>()));
  EXPECT_TRUE(names_itself(CapsuleEstimation<pcl::PointXYZ>()));
  EXPECT_TRUE(names_itself(EllipsoidEstimation<pcl::PointXYZ>()));
  EXPECT_TRUE(names_itself(BestEstimation<pcl::PointXYZ>()));
}

TEST(Estimation, ACloudThatIsANullPointerIsNoCloud) {
  AabbEstimation<pcl::PointXYZ> estimation;
  estimation.setInputCloud(random_cloud<pcl::PointXYZ>(10, 1));
  estimation.setInputCloud(nullptr);
  Aabb box;
  EXPECT_THROW(estimation.compute(box), std::logic_error);
}

TEST(Estimation, AnExecutorOfTheHostsGivesTheSameBits) {
  const auto cloud = random_cloud<pcl::PointXYZ>(200'000, 12);
  std::atomic<int> asked{0};
  const Executor executor{3, [&](std::size_t tasks, const std::function<void(std::size_t)>& task) {
                            ++asked;
                            std::vector<std::jthread> threads;
                            for (std::size_t i = 0; i < tasks; ++i)
                              threads.emplace_back(task, i);
                          }};
  Obb box, expected;
  expected = *fit_obb(*cloud, ObbMethod::minimal);
  box = *fit_obb(*cloud, ObbMethod::minimal, executor);
  EXPECT_EQ(box, expected);
  EXPECT_GT(asked, 0);
}

struct TwoCoordinates {
  float x, y;
};
struct Whole {
  int x, y, z;
};
struct Mixed {
  float x, y;
  double z;
};
struct Precise {
  double x, y, z;
};

static_assert(has_xyz<pcl::PointXYZ>::value && has_xyz<pcl::PointXYZRGBNormal>::value);
static_assert(has_xyz<Precise>::value);
static_assert(!has_xyz<TwoCoordinates>::value && !has_xyz<pcl::Normal>::value && !has_xyz<pcl::RGB>::value);
static_assert(!has_xyz<Whole>::value && !has_xyz<Mixed>::value);

}  // namespace
}  // namespace pcl_bv::detail
