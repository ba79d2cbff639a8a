// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The classes of the hull and the round shapes, and what PCL's models get of them.

#include <gtest/gtest.h>
#include <pcl/point_types.h>

#include <cmath>
#include <stdexcept>

#include "pcl_bv/estimation/bounding_volume_estimation.h"
#include "pcl_bv/estimation/fit_cloud.h"
#include "pcl_bv/estimation/model_coefficients.h"
#include "random_cloud.h"

namespace pcl_bv::detail {
namespace {

template <typename Estimation, typename Volume>
void expect_follows_indices_and_batches(Estimation& estimation) {
  const auto cloud = random_cloud<pcl::PointXYZ>(400, 9);
  estimation.setInputCloud(cloud);
  estimation.setNumberOfThreads(2);
  std::vector<pcl::PointIndices> clusters(2);
  for (int i = 0; i < 400; ++i)
    clusters[static_cast<std::size_t>(i % 2)].indices.push_back(i);
  std::vector<Volume> volumes;
  const std::vector<EstimationResult> results = estimation.compute(clusters, volumes);
  ASSERT_EQ(volumes.size(), 2u);
  for (std::size_t c = 0; c < 2; ++c) {
    EXPECT_EQ(results[c].used, 200u);
    EXPECT_EQ(results[c].rank, 3);
    estimation.setIndices(pcl::make_shared<pcl::Indices>(clusters[c].indices));
    Volume alone;
    EXPECT_EQ(estimation.compute(alone).status, EstimationStatus::ok);
    EXPECT_EQ(alone, volumes[c]);
    for (const int i : clusters[c].indices)
      EXPECT_TRUE(
          contains(AnyVolume(alone), (*cloud)[static_cast<std::size_t>(i)].getVector3fMap().cast<double>()));
  }
}

TEST(RoundEstimations, FollowIndicesAndBatches) {
  PrismEstimation<pcl::PointXYZ> prism;
  prism.setUpAxis({0, -1, 0});
  expect_follows_indices_and_batches<PrismEstimation<pcl::PointXYZ>, Prism>(prism);
  HullEstimation<pcl::PointXYZ> hull;
  expect_follows_indices_and_batches<HullEstimation<pcl::PointXYZ>, Hull>(hull);
  CylinderEstimation<pcl::PointXYZ> cylinder;
  expect_follows_indices_and_batches<CylinderEstimation<pcl::PointXYZ>, Cylinder>(cylinder);
  CapsuleEstimation<pcl::PointXYZ> capsule;
  expect_follows_indices_and_batches<CapsuleEstimation<pcl::PointXYZ>, Capsule>(capsule);
  EllipsoidEstimation<pcl::PointXYZ> ellipsoid;
  expect_follows_indices_and_batches<EllipsoidEstimation<pcl::PointXYZ>, Ellipsoid>(ellipsoid);
  BestEstimation<pcl::PointXYZ> best;
  expect_follows_indices_and_batches<BestEstimation<pcl::PointXYZ>, AnyVolume>(best);
}

TEST(RoundEstimations, BestChoosesAmongTheNamesGiven) {
  BestEstimation<pcl::PointXYZ> best;
  best.setInputCloud(random_cloud<pcl::PointXYZ>(100, 3));
  best.setMethods({"sphere", "ellipsoid"});
  AnyVolume volume;
  best.compute(volume);
  EXPECT_EQ(shape_name(volume), "ellipsoid");
  EXPECT_THROW(best.setMethods({}), std::invalid_argument);
  EXPECT_THROW(best.setMethods({"best"}), std::invalid_argument);
  EXPECT_THROW(best.setMethods({"aabb", "cone"}), std::invalid_argument);
}

TEST(RoundEstimations, TheEllipsoidsCertificateComesWithIt) {
  EllipsoidEstimation<pcl::PointXYZ> estimation;
  estimation.setInputCloud(random_cloud<pcl::PointXYZ>(1000, 4));
  Ellipsoid ellipsoid;
  EllipsoidCertificate certificate;
  estimation.compute(ellipsoid, certificate);
  EXPECT_LE(ellipsoid.volume(), certificate.lower_bound * (1 + 1e-5));
  EXPECT_GE(certificate.support.size(), 4u);
}

TEST(ModelCoefficients, OfACylinderAreSevenAndHoldIt) {
  const Eigen::Vector3d axis = Eigen::Vector3d(0.3, -0.5, 0.8).normalized();
  const Cylinder cylinder({500000.123, -3.1, 0.7}, axis, 0.123456789, 4);
  const pcl::ModelCoefficients model = to_model_coefficients(cylinder);
  ASSERT_EQ(model.values.size(), 7u);
  const Eigen::Vector3d point(model.values[0], model.values[1], model.values[2]);
  const Eigen::Vector3d direction(model.values[3], model.values[4], model.values[5]);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d p = cylinder.support(Eigen::Vector3d(std::cos(i), std::sin(i), std::cos(7 * i)));
    EXPECT_LE((p - point).cross(direction.normalized()).norm(), model.values[6]);
  }
  EXPECT_LT(model.values[6], 0.16F);
  EXPECT_EQ(to_model_coefficients(Sphere({1, 2, 3}, 4)).values, (std::vector<float>{1, 2, 3, 4}));
  EXPECT_EQ(to_model_coefficients(Cylinder()).values[6], -1);
  EXPECT_TRUE(std::isnan(to_model_coefficients(Cylinder()).values[0]));
}

}  // namespace
}  // namespace pcl_bv::detail
