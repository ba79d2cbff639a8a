// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The clusters are those of pcl::EuclideanClusterExtraction, on made and on real clouds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <pcl/segmentation/impl/extract_clusters.hpp>
#include <set>
#include <string>

#include "pcl_bv/synth/street.h"
#include "reference.h"

namespace {

using namespace pcl_bv;
using namespace pcl_bv::detail;
using namespace pcl_bv::test;
using IndexSets = std::set<std::vector<std::int32_t>>;

IndexSets pcl_clusters(const Cloud<float>& cloud, float tolerance) {
  const auto points = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  const auto finite = std::make_shared<pcl::Indices>();
  for (const auto& p : cloud) {
    if (std::isfinite(p[0] + p[1] + p[2])) finite->push_back(static_cast<int>(points->size()));
    points->push_back({p[0], p[1], p[2]});
  }
  pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setInputCloud(points);
  extraction.setIndices(finite);
  extraction.setSearchMethod(std::make_shared<pcl::search::KdTree<pcl::PointXYZ>>(false));
  extraction.setClusterTolerance(tolerance);
  std::vector<pcl::PointIndices> clusters;
  extraction.extract(clusters);
  IndexSets sets;
  for (auto& found : clusters)
    sets.insert(std::move(found.indices));
  return sets;
}

void expect_as_pcl(const Cloud<float>& cloud, float tolerance) {
  SCOPED_TRACE(testing::Message() << cloud.size() << " points, tolerance " << tolerance);
  const ClusterList ours = cluster(cloud, tolerance);
  EXPECT_TRUE(IndexSets(ours.begin(), ours.end()) == pcl_clusters(cloud, tolerance));
}

TEST(ClustersAsPcl, OnRandomCloudsOfManyDensities) {
  for (const float r : {0.01F, 0.05F, 0.2F, 0.5F, 1.F, 5.F}) {
    for (const float neighbours : {0.3F, 1.F, 3.F, 30.F}) {
      const float count = 1500;
      const float half_side = 0.5F * r * std::cbrt(4.19F * count / neighbours);
      for (const unsigned seed : {1U, 2U})
        expect_as_pcl(uniform_cloud(1500, half_side, seed), r);
    }
  }
}

TEST(ClustersAsPcl, OnObjectsInAStreet) {
  std::mt19937 random(4);
  std::normal_distribution<float> spread(0.F, 0.4F);
  std::uniform_real_distribution<float> place(-40.F, 40.F);
  Cloud<float> cloud;
  for (int object = 0; object < 60; ++object) {
    const float x = place(random);
    const float y = place(random);
    for (int i = 0; i < 100; ++i)
      cloud.push_back({x + spread(random), y + spread(random), spread(random)});
  }
  for (const float r : {0.1F, 0.2F, 0.3F, 0.5F, 1.F, 2.F})
    expect_as_pcl(cloud, r);
}

TEST(ClustersAsPcl, OnASweepOfTheStreet) {
  const SynthCloud sweep = make_street_frame({}, 0).cloud;
  Cloud<float> whole, above_ground;
  for (std::size_t i = 0; i < sweep.size(); ++i) {
    const std::array<float, 3> p{sweep.xyz[3 * i], sweep.xyz[3 * i + 1], sweep.xyz[3 * i + 2]};
    if (p == std::array<float, 3>{}) continue;  // Rays without a return, over which PCL broods for a second.
    whole.push_back(p);
    if (!sweep.ground[i]) above_ground.push_back(p);
  }
  ASSERT_GT(above_ground.size(), 40'000U);
  for (const float r : {0.01F, 0.1F, 0.2F, 0.5F, 1.F})
    expect_as_pcl(above_ground, r);
  expect_as_pcl(whole, 0.2F);
}

TEST(ClustersAsPcl, OnSheetsBarelyApart) {
  for (const float gap : {0.499F, 0.5F, 0.501F}) {
    Cloud<float> cloud = uniform_cloud(6000, 1.F, 10);
    for (std::size_t i = 0; i < cloud.size(); ++i)
      cloud[i][2] = 0.2F * cloud[i][0] + (i % 2 ? gap * 1.0198039F : 0.F);
    expect_as_pcl(cloud, 0.5F);
  }
}

TEST(ClustersAsPcl, OnSparseCloudsAndLargeTolerances) {
  expect_as_pcl(uniform_cloud(3000, 15.F, 11), 0.5F);
  expect_as_pcl(uniform_cloud(3000, 15.F, 11), 5.F);
  expect_as_pcl(uniform_cloud(3000, 200.F, 12), 5.F);
}

TEST(ClustersAsPcl, OnLatticesSpacedByTheTolerance) {
  for (const float r : {0.1F, 0.25F, 0.3F, 1.F}) {
    for (const float factor : {1.F, 1.F + 1e-7F, 1.F - 1e-7F})
      expect_as_pcl(lattice(8, r * factor), r);
  }
}

TEST(ClustersAsPcl, OnCloudsWithCopiesAndBadPoints) {
  Cloud<float> cloud = uniform_cloud(1500, 2.F, 9);
  cloud.insert(cloud.end(), cloud.begin(), cloud.begin() + 500);
  for (std::size_t i = 3; i < cloud.size(); i += 10)
    cloud[i][i % 3] = i % 20 == 3 ? NAN : INFINITY;
  for (const float r : {0.1F, 0.2F, 0.3F})
    expect_as_pcl(cloud, r);
}

Cloud<float> read_sweep(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::size_t count = 0;
  for (std::string line; std::getline(file, line) && line != "DATA binary";) {
    if (line.rfind("POINTS ", 0) == 0) count = std::stoul(line.substr(7));
  }
  Cloud<float> cloud;
  for (std::array<float, 4> record; cloud.size() < count;) {  // x y z intensity
    if (!file.read(reinterpret_cast<char*>(record.data()), sizeof record)) throw std::runtime_error(path);
    cloud.push_back({record[0], record[1], record[2]});
  }
  return cloud;
}

TEST(ClustersAsPcl, OnSweepsOfALidar) {
  const char* const data = std::getenv("PCL_BV_DATA");
  if (!data) GTEST_SKIP() << "PCL_BV_DATA is not set";
  for (const char* name : {"0000000000.pcd", "0000000011.pcd", "0000000021.pcd"}) {
    SCOPED_TRACE(name);
    Cloud<float> cloud = read_sweep(std::filesystem::path(data) / "lidar_sequence" / name);
    ASSERT_GT(cloud.size(), 100'000U);
    expect_as_pcl(cloud, 0.1F);
    std::erase_if(cloud, [](const auto& p) { return p[2] <= -1.4F; });  // the ground
    for (const float r : {0.2F, 0.5F})
      expect_as_pcl(cloud, r);
  }
}

}  // namespace
