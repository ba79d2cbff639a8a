// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The PCL-style class: what it adds to the clusterer, and that code written for PCL's class compiles with it.
#include "pcl_bv/segmentation/extract_clusters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>

#include <pcl/segmentation/impl/extract_clusters.hpp>
#include <set>
#include <stdexcept>

#include "reference.h"

// A point type that PCL has never heard of: x at an offset, no padding.
struct Reflection {
  double stamp;
  float power;
  float x, y, z;
};

namespace {

using testing::ElementsAre;
using testing::IsEmpty;

template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr cloud_of(const pcl_bv::test::Cloud<float>& points) {
  const auto cloud = std::make_shared<pcl::PointCloud<PointT>>();
  for (const auto& p : points) {
    PointT point{};
    point.x = p[0];
    point.y = p[1];
    point.z = p[2];
    cloud->push_back(point);
  }
  cloud->header.frame_id = "lidar";
  cloud->header.stamp = 42;
  return cloud;
}

TEST(ExtractClusters, MinPointsTellsNoiseApart) {
  pcl_bv::test::Cloud<float> points;
  for (int i = 0; i < 20; ++i)
    points.push_back({0.1F * static_cast<float>(i), 0, 0});
  points.push_back({2.4F, 0, 0});  // near to the last one only
  pcl_bv::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setInputCloud(cloud_of<pcl::PointXYZ>(points));
  extraction.setClusterTolerance(0.55);
  std::vector<pcl::PointIndices> clusters;
  for (const auto& [least, size] : {std::pair(1U, 21U), std::pair(3U, 21U), std::pair(8U, 20U)}) {
    extraction.setMinPoints(least);
    EXPECT_EQ(extraction.getMinPoints(), least);
    extraction.extract(clusters);
    ASSERT_EQ(clusters.size(), 1U) << least;
    EXPECT_EQ(clusters[0].indices.size(), size) << least;
  }
  extraction.setMinPoints(0);
  EXPECT_THROW(extraction.extract(clusters), std::invalid_argument);
}

TEST(ExtractClusters, TheToleranceGrowsAndOversizedClustersAreKeptIfToldSo) {
  pcl_bv::test::Cloud<float> points;
  for (int i = 0; i < 20; ++i)
    points.push_back({100, 0.3F * static_cast<float>(i), 0});
  pcl_bv::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setInputCloud(cloud_of<pcl::PointXYZ>(points));
  extraction.setClusterTolerance(0.2);
  extraction.setMinClusterSize(2);
  extraction.setMaxClusterSize(15);
  std::vector<pcl::PointIndices> clusters;
  extraction.setOversized(pcl_bv::Oversized::keep);
  EXPECT_EQ(extraction.getOversized(), pcl_bv::Oversized::keep);
  extraction.extract(clusters);
  EXPECT_EQ(clusters.size(), 0U);
  extraction.setToleranceGrowth(0.005);
  EXPECT_EQ(extraction.getToleranceGrowth(), 0.005);
  extraction.extract(clusters);
  ASSERT_EQ(clusters.size(), 1U);
  EXPECT_EQ(clusters[0].indices.size(), 20U);
  extraction.setOversized(pcl_bv::Oversized::drop);
  extraction.extract(clusters);
  EXPECT_EQ(clusters.size(), 0U);
  extraction.setToleranceGrowth(-1);
  EXPECT_THROW(extraction.extract(clusters), std::invalid_argument);
}

// Written for PCL; both classes must serve.
template <typename Extraction, typename PointT>
std::vector<pcl::PointIndices> run(const typename pcl::PointCloud<PointT>::Ptr& cloud,
                                   const pcl::IndicesPtr& indices) {
  typename pcl::search::KdTree<PointT>::Ptr tree(new pcl::search::KdTree<PointT>);
  Extraction extraction;
  extraction.setClusterTolerance(0.15);
  extraction.setMinClusterSize(2);
  extraction.setMaxClusterSize(200);
  extraction.setSearchMethod(tree);
  extraction.setInputCloud(cloud);
  if (indices) extraction.setIndices(indices);
  EXPECT_EQ(extraction.getSearchMethod(), tree);
  EXPECT_EQ(extraction.getClusterTolerance(), 0.15);
  EXPECT_EQ(extraction.getMinClusterSize(), 2U);
  EXPECT_EQ(extraction.getMaxClusterSize(), 200U);
  std::vector<pcl::PointIndices> clusters;
  extraction.extract(clusters);
  return clusters;
}

std::set<pcl::Indices> sets(const std::vector<pcl::PointIndices>& clusters) {
  std::set<pcl::Indices> all;
  for (const auto& c : clusters)
    all.insert(c.indices);
  return all;
}

TEST(ExtractClusters, IsADropInForPclsClass) {
  using Point = pcl::PointXYZI;
  const auto cloud = cloud_of<Point>(pcl_bv::test::uniform_cloud(1200, 1.F, 41));
  const auto every_other = std::make_shared<pcl::Indices>();
  for (int i = 0; i < 1200; i += 2)
    every_other->push_back(1198 - i);
  for (const auto& indices : {pcl::IndicesPtr(), pcl::IndicesPtr(every_other)}) {
    const auto ours = run<pcl_bv::EuclideanClusterExtraction<Point>, Point>(cloud, indices);
    const auto theirs = run<pcl::EuclideanClusterExtraction<Point>, Point>(cloud, indices);
    EXPECT_GT(ours.size(), 10U);
    EXPECT_EQ(sets(ours), sets(theirs));
    for (std::size_t i = 0; i < ours.size(); ++i)
      EXPECT_EQ(ours[i].indices.size(), theirs[i].indices.size());
  }
}

TEST(ExtractClusters, ANullOfAnyKindMeansTheWholeCloud) {
  pcl_bv::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setInputCloud(cloud_of<pcl::PointXYZ>({{0, 0, 0}, {5, 0, 0}}));
  extraction.setClusterTolerance(1);
  const auto clusters = [&extraction] {
    std::vector<pcl::PointIndices> found;
    extraction.extract(found);
    return found.size();
  };
  extraction.setIndices(pcl::IndicesPtr(new pcl::Indices{1}));
  EXPECT_EQ(clusters(), 1U);
  extraction.setIndices(nullptr);
  EXPECT_EQ(clusters(), 2U);
  extraction.setIndices(pcl::IndicesConstPtr());
  EXPECT_EQ(clusters(), 2U);
  extraction.setIndices(pcl::PointIndicesConstPtr());
  EXPECT_EQ(clusters(), 2U);
}

TEST(ExtractClusters, CopiesTheHeaderIntoEachCluster) {
  const auto cloud = cloud_of<pcl::PointXYZ>({{0, 0, 0}, {5, 0, 0}});
  pcl_bv::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setInputCloud(cloud);
  extraction.setClusterTolerance(1);
  std::vector<pcl::PointIndices> clusters;
  extraction.extract(clusters);
  ASSERT_EQ(clusters.size(), 2U);
  EXPECT_EQ(clusters[1].header.frame_id, "lidar");
  EXPECT_EQ(clusters[1].header.stamp, 42U);
}

TEST(ExtractClusters, ReplacesWhatTheVectorHeld) {
  pcl_bv::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setInputCloud(cloud_of<pcl::PointXYZ>({{0, 0, 0}, {0.5F, 0, 0}}));
  extraction.setClusterTolerance(1);
  std::vector<pcl::PointIndices> clusters(7);
  clusters[0].indices = {5, 6, 7};
  extraction.extract(clusters);
  EXPECT_EQ(sets(clusters), (std::set<pcl::Indices>{{0, 1}}));
  EXPECT_EQ(clusters.size(), 1U);
}

TEST(ExtractClusters, TakesAnyPointTypeWithFloatCoordinates) {
  const auto points = pcl_bv::test::uniform_cloud(500, 1.F, 42);
  pcl_bv::EuclideanClusterExtraction<Reflection> extraction;
  extraction.setInputCloud(cloud_of<Reflection>(points));
  extraction.setClusterTolerance(0.2F);
  std::vector<pcl::PointIndices> clusters;
  extraction.extract(clusters);
  pcl_bv::test::ClusterList lists;
  for (const auto& c : clusters)
    lists.push_back(c.indices);
  EXPECT_EQ(lists, pcl_bv::test::brute_force(points, 0.2F));
}

TEST(ExtractClusters, TakesNullIndicesAsTheWholeCloud) {
  pcl_bv::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setInputCloud(cloud_of<pcl::PointXYZ>({{0, 0, 0}, {0.5F, 0, 0}, {3, 0, 0}}));
  extraction.setClusterTolerance(1);
  extraction.setIndices(std::make_shared<pcl::Indices>(pcl::Indices{2}));
  std::vector<pcl::PointIndices> clusters;
  extraction.extract(clusters);
  EXPECT_EQ(sets(clusters), (std::set<pcl::Indices>{{2}}));
  extraction.setIndices(pcl::IndicesPtr());
  extraction.extract(clusters);
  EXPECT_EQ(sets(clusters), (std::set<pcl::Indices>{{0, 1}, {2}}));
}

TEST(ExtractClusters, FindsNoneInEmptyInput) {
  pcl_bv::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setClusterTolerance(1);
  std::vector<pcl::PointIndices> clusters(3);
  extraction.setInputCloud(cloud_of<pcl::PointXYZ>({}));
  extraction.extract(clusters);
  EXPECT_THAT(clusters, IsEmpty());
  clusters.resize(3);
  extraction.setInputCloud(cloud_of<pcl::PointXYZ>({{0, 0, 0}}));
  extraction.setIndices(std::make_shared<pcl::Indices>());
  extraction.extract(clusters);
  EXPECT_THAT(clusters, IsEmpty());
}

TEST(ExtractClusters, RefusesWrongUse) {
  std::vector<pcl::PointIndices> clusters;
  pcl_bv::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setClusterTolerance(1);
  EXPECT_THROW(extraction.extract(clusters), std::logic_error);
  extraction.setInputCloud(cloud_of<pcl::PointXYZ>({{0, 0, 0}, {1, 0, 0}}));
  for (const int bad : {-1, 2}) {
    extraction.setIndices(std::make_shared<pcl::Indices>(pcl::Indices{0, bad}));
    EXPECT_THROW(extraction.extract(clusters), std::out_of_range) << bad;
  }
  extraction.setIndices(pcl::IndicesPtr());
  for (const double bad : {0.0, -1.0, 1e-60, 1e60}) {
    extraction.setClusterTolerance(bad);
    EXPECT_THROW(extraction.extract(clusters), std::invalid_argument) << bad;
  }
  extraction.setClusterTolerance(1);
  extraction.setMinClusterSize(3);
  extraction.setMaxClusterSize(2);
  EXPECT_THROW(extraction.extract(clusters), std::invalid_argument);
}

TEST(ExtractClusters, AreTheSameForEveryNumberOfThreads) {
  pcl_bv::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setInputCloud(cloud_of<pcl::PointXYZ>(pcl_bv::test::uniform_cloud(30'000, 1.F, 43)));
  extraction.setClusterTolerance(0.03);
  std::vector<pcl::PointIndices> expected, clusters;
  extraction.extract(expected);
  EXPECT_GT(expected.size(), 100U);
  for (const unsigned threads : {0U, 2U, 5U}) {
    extraction.setNumberOfThreads(threads);
    extraction.extract(clusters);
    ASSERT_EQ(clusters.size(), expected.size());
    for (std::size_t i = 0; i < clusters.size(); ++i)
      EXPECT_EQ(clusters[i].indices, expected[i].indices);
  }
}

}  // namespace
