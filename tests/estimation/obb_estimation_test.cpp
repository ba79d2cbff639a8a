// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Claims of the estimator of oriented boxes and of what goes to PCL's visualizer.

#include <gtest/gtest.h>
#include <pcl/point_types.h>

#include <cmath>
#include <random>

#include "pcl_bv/estimation/bounding_volume_estimation.h"
#include "pcl_bv/estimation/fit_cloud.h"
#include "pcl_bv/estimation/model_coefficients.h"

namespace pcl_bv::detail {
namespace {

template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr random_cloud(std::size_t points, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<float> normal(3, 2);
  typename pcl::PointCloud<PointT>::Ptr cloud(new pcl::PointCloud<PointT>);
  for (std::size_t i = 0; i < points; ++i) {
    PointT p;
    p.x = normal(random);
    p.y = normal(random);
    p.z = normal(random);
    cloud->push_back(p);
  }
  return cloud;
}

TEST(ObbEstimation, HasMethodsAnUpAxisIndicesAndABatch) {
  const auto cloud = random_cloud<pcl::PointXYZI>(1000, 8);
  ObbEstimation<pcl::PointXYZI> estimation;
  EXPECT_EQ(estimation.getMethod(), ObbMethod::minimal);
  EXPECT_EQ(estimation.getUpAxis(), Eigen::Vector3d::UnitZ());
  estimation.setInputCloud(cloud);
  std::vector<pcl::PointIndices> clusters(2);
  for (int i = 0; i < 1000; ++i)
    clusters[i % 3 == 0 ? 0 : 1].indices.push_back(i);
  for (const ObbMethod method :
       {ObbMethod::pca, ObbMethod::dito14, ObbMethod::minimal, ObbMethod::yaw, ObbMethod::lshape}) {
    estimation.setMethod(method);
    estimation.setUpAxis({1, 2, 2});
    Obb box, expected;
    EXPECT_EQ(estimation.compute(box).status, EstimationStatus::ok);
    expected = *fit_obb(*cloud, {method, {1, 2, 2}});
    EXPECT_EQ(box, expected);
    std::vector<Obb> boxes;
    const std::vector<EstimationResult> results = estimation.compute(clusters, boxes);
    EXPECT_EQ(results[0].used, 334U);
    expected = *fit_obb(*cloud, clusters[1].indices, {method, {1, 2, 2}});
    EXPECT_EQ(boxes[1], expected);
  }
  estimation.setUpAxis({0, 0, 0});
  Obb box;
  EXPECT_THROW(estimation.compute(box), std::invalid_argument);
}

TEST(Estimation, ModelCoefficientsAreThoseOfTheVisualizer) {
  Eigen::Matrix3d axes;
  axes << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const float half = std::sqrt(0.5F);
  EXPECT_EQ(to_model_coefficients(Obb({1, 2, 3}, axes, {4, 2, 0.5})).values,
            (std::vector<float>{1, 2, 3, 0, 0, half, half, 8, 4, 1}));
  EXPECT_EQ(to_model_coefficients(Sphere({1, 2, 3}, 4)).values, (std::vector<float>{1, 2, 3, 4}));
  EXPECT_EQ(to_model_coefficients(Obb()).values.size(), 10U);
  for (const float value : to_model_coefficients(Obb()).values)
    EXPECT_TRUE(std::isnan(value));
  EXPECT_EQ(to_model_coefficients(Sphere()).values[3], -1);
}

}  // namespace
}  // namespace pcl_bv::detail
