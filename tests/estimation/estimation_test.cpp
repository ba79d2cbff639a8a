// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/estimation/bounding_volume_estimation.h"

#include <gtest/gtest.h>
#include <pcl/common/centroid.h>
#include <pcl/common/common.h>
#include <pcl/point_types.h>

#include <cstdlib>
#include <limits>
#include <memory>
#include <random>

#include "pcl_bv/estimation/fit_cloud.h"
#include "random_cloud.h"

namespace pcl_bv::detail {
namespace {

template <typename PointT>
class EveryPointType : public testing::Test {};

struct Packed {
  float x, y, z;
};
struct Behind {
  char id[8];
  float x, y, z;
  float age;
};
using PointTypes = testing::Types<pcl::PointXYZ, pcl::PointXYZI, pcl::PointXYZRGB, pcl::PointNormal,
                                  pcl::PointXYZRGBNormal, pcl::PointXYZL, Packed, Behind>;
TYPED_TEST_SUITE(EveryPointType, PointTypes);

TYPED_TEST(EveryPointType, AabbIsTheMinimumAndMaximum) {
  const auto cloud = random_cloud<TypeParam>(1003, 1);
  Eigen::Vector3f low = Eigen::Vector3f::Constant(1e9F), high = -low;
  for (const auto& p : *cloud) {
    low = low.cwiseMin(Eigen::Vector3f(p.x, p.y, p.z));
    high = high.cwiseMax(Eigen::Vector3f(p.x, p.y, p.z));
  }
  AabbEstimation<TypeParam> estimation;
  estimation.setInputCloud(cloud);
  Aabb box;
  const EstimationResult result = estimation.compute(box);
  EXPECT_EQ(result.status, EstimationStatus::ok);
  EXPECT_EQ(result.used, 1003U);
  EXPECT_EQ(box.min(), low.cast<double>());
  EXPECT_EQ(box.max(), high.cast<double>());
}

TEST(Estimation, AgreesWithGetMinMax3DOnACloudWithNaN) {
  const auto cloud = random_cloud<pcl::PointXYZ>(5000, 2);
  for (std::size_t i = 0; i < cloud->size(); i += 7)
    (*cloud)[i].y = std::numeric_limits<float>::quiet_NaN();
  cloud->is_dense = false;
  pcl::PointXYZ low, high;
  pcl::getMinMax3D(*cloud, low, high);
  for (const bool dense : {false, true}) {
    cloud->is_dense = dense;  // what it says must not matter
    const Fitted<Aabb> box = fit_aabb(*cloud);
    EXPECT_EQ(box.dropped, 715U);
    EXPECT_EQ(box->min(), low.getVector3fMap().cast<double>());
    EXPECT_EQ(box->max(), high.getVector3fMap().cast<double>());
  }
}

TEST(Estimation, ASummaryAgreesWithComputeMeanAndCovarianceMatrix) {
  const auto cloud = random_cloud<pcl::PointXYZI>(5000, 6);
  pcl::Indices odd;
  for (int i = 1; i < 5000; i += 2)
    odd.push_back(i);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  Eigen::Vector4d mean = Eigen::Vector4d::Zero();
  pcl::computeMeanAndCovarianceMatrix(*cloud, covariance, mean);
  const CloudSummary summary = summarize(*cloud);
  EXPECT_TRUE(summary.centroid.isApprox(mean.head<3>(), 1e-12));
  EXPECT_TRUE(summary.covariance.isApprox(covariance, 1e-12));
  pcl::computeMeanAndCovarianceMatrix(*cloud, odd, covariance, mean);
  const CloudSummary half = summarize(*cloud, odd);
  EXPECT_EQ(half.used, 2500U);
  EXPECT_TRUE(half.centroid.isApprox(mean.head<3>(), 1e-12));
  EXPECT_TRUE(half.covariance.isApprox(covariance, 1e-12));
}

TEST(Estimation, IndicesRestrictAndNullLiftsTheRestriction) {
  const auto cloud = random_cloud<pcl::PointXYZ>(1000, 3);
  const auto indices = std::make_shared<pcl::Indices>(pcl::Indices{5, 17, 900});
  KdopEstimation<pcl::PointXYZ, 14> estimation;
  estimation.setInputCloud(cloud);
  Kdop all, some, expected;
  estimation.compute(all);
  estimation.setIndices(pcl::IndicesPtr(indices));
  EXPECT_EQ(estimation.compute(some).used, 3U);
  pcl::PointCloud<pcl::PointXYZ> three;
  for (const int i : *indices)
    three.push_back((*cloud)[static_cast<std::size_t>(i)]);
  expected = *fit_kdop(three, KdopSet::dop14());
  for (std::size_t k = 0; k < 7; ++k) {
    EXPECT_EQ(some.min(k), expected.min(k));
    EXPECT_EQ(some.max(k), expected.max(k));
  }
  estimation.setIndices(pcl::IndicesPtr());
  EXPECT_EQ(estimation.compute(some).used, 1000U);
  EXPECT_EQ(some.max(3), all.max(3));
}

TEST(Estimation, TakesIndicesInEveryFormOfPcl) {
  const auto cloud = random_cloud<pcl::PointXYZ>(12, 3);
  cloud->width = 4;
  cloud->height = 3;
  AabbEstimation<pcl::PointXYZ> estimation;
  estimation.setInputCloud(cloud);
  Aabb box;
  estimation.setIndices(pcl::IndicesConstPtr(new pcl::Indices{1, 2}));
  EXPECT_EQ(estimation.compute(box).used, 2U);
  const pcl::PointIndices::Ptr point_indices(new pcl::PointIndices);
  point_indices->indices = {1, 2, 3};
  estimation.setIndices(pcl::PointIndicesConstPtr(point_indices));
  EXPECT_EQ(estimation.compute(box).used, 3U);
  estimation.setIndices(1, 1, 2, 2);
  EXPECT_EQ(estimation.compute(box).used, 4U);
}

TEST(Estimation, ANullOfAnyKindLiftsTheRestriction) {
  const auto cloud = random_cloud<pcl::PointXYZ>(12, 3);
  AabbEstimation<pcl::PointXYZ> estimation;
  estimation.setInputCloud(cloud);
  Aabb box;
  const auto restrict_to_one = [&] { estimation.setIndices(pcl::IndicesPtr(new pcl::Indices{1})); };
  restrict_to_one();
  estimation.setIndices(nullptr);
  EXPECT_EQ(estimation.compute(box).used, 12U);
  restrict_to_one();
  estimation.setIndices(pcl::IndicesConstPtr());
  EXPECT_EQ(estimation.compute(box).used, 12U);
  restrict_to_one();
  estimation.setIndices(pcl::PointIndicesConstPtr());
  EXPECT_EQ(estimation.compute(box).used, 12U);
}

TEST(Estimation, AKdopTellsWhichPointsOfTheCloudTouchIt) {
  const auto cloud = random_cloud<pcl::PointNormal>(1000, 9);
  KdopEstimation<pcl::PointNormal, 18> estimation;
  estimation.setInputCloud(cloud);
  const auto odd = std::make_shared<pcl::Indices>();
  for (int i = 999; i > 0; i -= 2)
    odd->push_back(i);
  Kdop kdop, expected;
  SlabPoints touching;
  for (const pcl::IndicesPtr& indices : {pcl::IndicesPtr(), pcl::IndicesPtr(odd)}) {
    estimation.setIndices(indices);
    EXPECT_EQ(estimation.compute(kdop, touching).used, indices ? 500U : 1000U);
    estimation.compute(expected);
    EXPECT_EQ(kdop, expected);
    ASSERT_EQ(touching.max.size(), 9U);
    EXPECT_EQ((*cloud)[touching.max[2]].z, kdop.max(2));
    EXPECT_EQ((*cloud)[touching.min[0]].x, kdop.min(0));
  }
  EXPECT_EQ(touching.max[2] % 2, 1U) << "indices are the cloud's";
  const SlabPoints also = fit_kdop_with_contacts(*cloud, *odd, KdopSet::dop18()).contacts;
  EXPECT_EQ(also.min, touching.min);
  EXPECT_EQ(also.max, touching.max);
  const auto whole = fit_kdop_with_contacts(*cloud, KdopSet::dop18());
  EXPECT_EQ((*cloud)[whole.contacts.min[1]].y, whole->min(1));
}

struct Scattered {
  float x;
  int id;
  float y, z;
};
struct Reversed {
  float z, y, x;
};

TEST(Estimation, PointTypesThatScatterTheirCoordinatesAreErrors) {
  Aabb box;
  EXPECT_THROW(fit_aabb(*random_cloud<Scattered>(10, 1)), std::invalid_argument);
  EXPECT_THROW(fit_aabb(*random_cloud<Reversed>(10, 1)), std::invalid_argument);
}

TEST(Estimation, ABadEnvironmentIsAnErrorWhereAnEstimatorIsMadeAndNoneLater) {
  AabbEstimation<pcl::PointXYZ> estimation;
  estimation.setInputCloud(random_cloud<pcl::PointXYZ>(10, 1));
  std::vector<Aabb> boxes;
  const char* old = std::getenv("PCL_BV_ISA");
  const std::string saved = old == nullptr ? "" : old;
  setenv("PCL_BV_ISA", "foo", 1);
  EXPECT_THROW(AabbEstimation<pcl::PointXYZ>(), std::invalid_argument);
  EXPECT_NO_THROW(estimation.compute(std::vector<pcl::PointIndices>(3), boxes));
  setenv("PCL_BV_ISA", saved.c_str(), 1);
  EXPECT_EQ(boxes.size(), 3U);
}

TEST(Estimation, ABatchEqualsOneByOne) {
  const auto cloud = random_cloud<pcl::PointXYZI>(3000, 4);
  std::vector<pcl::PointIndices> clusters(40);
  for (std::size_t i = 0; i < cloud->size(); ++i)
    clusters[i * i % 39].indices.push_back(static_cast<int>(i));
  ASSERT_TRUE(clusters[39].indices.empty());
  SphereEstimation<pcl::PointXYZI> estimation;
  estimation.setInputCloud(cloud);
  for (const unsigned threads : {1U, 2U, 0U}) {
    estimation.setNumberOfThreads(threads);
    std::vector<Sphere> spheres;
    const std::vector<EstimationResult> results = estimation.compute(clusters, spheres);
    ASSERT_EQ(spheres.size(), clusters.size());
    for (std::size_t c = 0; c < clusters.size(); ++c) {
      Sphere sphere;
      sphere = *fit_sphere(*cloud, clusters[c].indices, SphereMethod::exact);
      EXPECT_EQ(results[c].used, clusters[c].indices.size());
      EXPECT_EQ(spheres[c].radius(), sphere.radius()) << "cluster " << c;
      if (!sphere.empty()) {
        EXPECT_EQ(spheres[c].center(), sphere.center());
      }
    }
  }
}

TEST(Estimation, AnEmptyCloudGivesAnEmptyVolumeAndSaysSo) {
  SphereEstimation<pcl::PointXYZ> estimation;
  estimation.setInputCloud(pcl::PointCloud<pcl::PointXYZ>::ConstPtr(new pcl::PointCloud<pcl::PointXYZ>));
  Sphere sphere({1, 2, 3}, 4);
  EXPECT_EQ(estimation.compute(sphere).status, EstimationStatus::no_valid_points);
  EXPECT_TRUE(sphere.empty());
}

TEST(Estimation, NoCloudIsALogicError) {
  AabbEstimation<pcl::PointXYZ> estimation;
  Aabb box;
  EXPECT_THROW(estimation.compute(box), std::logic_error);
  std::vector<Aabb> boxes;
  EXPECT_THROW(estimation.compute({pcl::PointIndices()}, boxes), std::logic_error);
}

TEST(Estimation, AnIndexOutsideTheCloudIsAnErrorThatNamesIt) {
  const auto cloud = random_cloud<pcl::PointXYZ>(10, 5);
  Aabb box;
  for (const int bad : {-1, 10, 1'000'000}) {
    try {
      fit_aabb(*cloud, pcl::Indices{0, bad});
      FAIL() << "accepted " << bad;
    } catch (const std::out_of_range& error) {
      EXPECT_NE(std::string(error.what()).find(std::to_string(bad)), std::string::npos) << error.what();
    }
  }
}

TEST(Estimation, RefusesAnInstructionSetThatIsNotUsable) {
  AabbEstimation<pcl::PointXYZ> estimation;
  EXPECT_NO_THROW(estimation.setInstructionSet(Isa::scalar));
#if defined(__x86_64__)
  EXPECT_THROW(estimation.setInstructionSet(Isa::neon), std::invalid_argument);
#else
  EXPECT_THROW(estimation.setInstructionSet(Isa::avx2), std::invalid_argument);
#endif
}

}  // namespace
}  // namespace pcl_bv::detail
