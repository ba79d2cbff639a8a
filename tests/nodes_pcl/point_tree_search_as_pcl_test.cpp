// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// PCL's algorithms give with PointTreeSearch what they give with pcl::search::KdTree, on made and on real
// clouds.
#include <gtest/gtest.h>
#include <pcl/search/kdtree.h>
#include <pcl/features/impl/normal_3d.hpp>
#include <pcl/features/impl/normal_3d_omp.hpp>
#include <pcl/segmentation/impl/extract_clusters.hpp>

#include <cstdlib>
#include <set>
#include <string>

#include "clouds.h"
#include "neighbours.h"
#include "pcl_bv/io/read_cloud.h"

namespace pcl_bv::detail {
namespace {

using namespace test;
using Ours = PointTreeSearch<pcl::PointXYZ>;
using Theirs = pcl::search::KdTree<pcl::PointXYZ>;
using IndexSets = std::multiset<pcl::Indices>;

// A cloud, the points of it that are searched (null: all), and what to ask.
struct Case {
  std::string name;
  PointsXyz::Ptr cloud;
  pcl::IndicesPtr indices;
  std::vector<float> radii;
};

// Without dead beams, and of its points those above this height over the sensor.
PointsXyz::Ptr sweep_of_a_lidar(double height) {
  const RawCloud raw = read_cloud(std::string(std::getenv("PCL_BV_DATA")) + "/lidar_sequence/0000000000.pcd");
  const PointsXyz::Ptr cloud(new PointsXyz);
  for (std::size_t i = 0; i < raw.xyz().count; ++i) {
    const Coordinates p = load_point(raw.xyz(), i);
    if (p.z > height && (p.x != 0 || p.y != 0 || p.z != 0))
      cloud->push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
  }
  return cloud;
}

const std::vector<Case>& cases() {
  static const std::vector<Case> all = [] {
    const PointsXyz::Ptr sweep = street(16'000);
    std::vector<Case> made = {{"uniform", uniform(3000, 2, 1), nullptr, {0.1F, 0.3F, 1}},
                              {"a list", uniform(3000, 2, 1), every(3, 3000), {0.1F, 0.3F, 1}},
                              {"UTM", uniform(3000, 20, 2, 5e6F), nullptr, {0.7F, 1, 3}},
                              {"street", sweep, nullptr, {0.2F, 0.5F}},
                              {"part of a street", sweep, every(2, sweep->size()), {0.5F}},
                              {"one point", points_of({1, 2, 3}), nullptr, {1}}};
    PointsXyz::Ptr twice(new PointsXyz(*uniform(1000, 2, 3)));
    *twice += *twice;
    made.push_back({"every point twice", twice, nullptr, {0.2F, 0.4F}});
    PointsXyz::Ptr flat(new PointsXyz(*uniform(2000, 2, 4)));
    for (pcl::PointXYZ& p : *flat)
      p.z = 1;
    made.push_back({"flat", flat, nullptr, {0.05F, 0.1F}});
    if (std::getenv("PCL_BV_DATA") != nullptr) {
      made.push_back({"a recorded sweep", sweep_of_a_lidar(-100), nullptr, {0.1F, 0.3F}});
      made.push_back({"what stands in it", sweep_of_a_lidar(-1.4), nullptr, {0.2F, 0.5F}});
    }
    return made;
  }();
  return all;
}

template <typename Search>
std::shared_ptr<Search> tree_of(const Case& one, bool sorted = true) {
  const auto tree = std::make_shared<Search>(sorted);
  tree->setInputCloud(one.cloud, one.indices);
  return tree;
}

void expect_same_neighbours(const Case& one, std::size_t step) {
  SCOPED_TRACE(one.name);
  const auto ours = tree_of<Ours>(one);
  const auto theirs = tree_of<Theirs>(one);
  for (std::size_t i = 0; i < one.cloud->size(); i += step) {
    const pcl::PointXYZ& place = (*one.cloud)[i];
    if (!pcl::isFinite(place)) continue;
    for (const int k : {1, 6, 40}) {
      const Answer a = nearest(*ours, place, k), b = nearest(*theirs, place, k);
      ASSERT_EQ(a.count, b.count);
      for (std::size_t j = 0; j < a.squares.size(); ++j)
        ASSERT_NEAR(a.squares[j], b.squares[j], kFloatError * a.squares[j]);
      expect_same_up_to_rounding(a, b, a.squares.back());
    }
    for (const float r : one.radii) {
      expect_same_up_to_rounding(within(*ours, place, r), within(*theirs, place, r), r * r);
      const Answer a = within(*ours, place, r, 9), b = within(*theirs, place, r, 9);
      expect_same_up_to_rounding(a, b, a.count < 9 ? r * r : a.squares.back());
    }
  }
}

TEST(PointTreeSearchAsPcl, FindsTheNeighboursOfPclsTree) {
  for (const Case& one : cases())
    expect_same_neighbours(one, one.cloud->size() / 1000 + 1);
}

TEST(PointTreeSearchAsPcl, FindsTheNeighboursOfPclsTreeInNastyClouds) {
  for (const TestCloud<float>& made : nasty_clouds<float>()) {
    float most = 0;
    for (const float c : made.xyz) {
      if (std::isfinite(c)) most = std::max(most, std::abs(c));
    }
    // PCL's float holds no squares of others, and its tree of no points crashes.
    if (made.name.starts_with("nothing") || most > 1e15F || (most > 0 && most < 1e-10F) || made.size() == 0)
      continue;
    expect_same_neighbours({made.name, points_of(made.xyz), nullptr, {0.05F * most, 0.3F * most, 1}}, 11);
  }
}

IndexSets clusters_by(const SearchXyz::Ptr& tree, const Case& one, float tolerance, unsigned least = 1) {
  pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setInputCloud(one.cloud);
  if (one.indices) extraction.setIndices(one.indices);
  extraction.setSearchMethod(tree);
  extraction.setClusterTolerance(tolerance);
  extraction.setMinClusterSize(least);
  std::vector<pcl::PointIndices> clusters;
  extraction.extract(clusters);
  IndexSets sets;
  for (pcl::PointIndices& cluster : clusters)
    sets.insert(std::move(cluster.indices));
  return sets;
}

TEST(PointTreeSearchAsPcl, GivesEuclideanClusterExtractionTheSameClusters) {
  for (const Case& one : cases()) {
    if (one.name == "a recorded sweep") continue;  // over whose ground PCL takes a minute
    for (const float tolerance : one.radii) {
      SCOPED_TRACE(one.name + ", tolerance " + std::to_string(tolerance));
      const IndexSets expected = clusters_by(std::make_shared<Theirs>(false), one, tolerance);
      EXPECT_TRUE(clusters_by(std::make_shared<Ours>(false), one, tolerance) == expected);
      EXPECT_TRUE(clusters_by(std::make_shared<Ours>(true), one, tolerance) == expected);
    }
  }
}

TEST(PointTreeSearchAsPcl, GivesClustersOfPointsThatAreFiniteOnly) {
  Case one{"holes", PointsXyz::Ptr(new PointsXyz(*uniform(3000, 2, 5))), every(1, 3000), {}};
  pcl::IndicesPtr finite(new pcl::Indices);
  for (std::size_t i = 0; i < one.cloud->size(); ++i) {
    if (i % 7 == 3)
      (*one.cloud)[i].y = i % 2 != 0 ? std::numeric_limits<float>::quiet_NaN() : INFINITY;
    else
      finite->push_back(static_cast<int>(i));
  }
  const Case valid{"their others", one.cloud, finite, {}};
  const IndexSets expected = clusters_by(std::make_shared<Theirs>(false), valid, 0.25F, 2);
  EXPECT_GT(expected.size(), 10U);
  EXPECT_TRUE(clusters_by(std::make_shared<Ours>(false), one, 0.25F, 2) == expected);
  EXPECT_TRUE(clusters_by(std::make_shared<Ours>(true), valid, 0.25F, 2) == expected);
}

// Of clouds so small and so large that PCL's float has no squares for them: as the same clouds of usual size.
TEST(PointTreeSearchAsPcl, GivesTheSameClustersWhateverTheUnit) {
  const Case usual{"usual", uniform(2000, 2, 6), nullptr, {}};
  const IndexSets expected = clusters_by(std::make_shared<Theirs>(false), usual, 0.25F);
  EXPECT_GT(expected.size(), 50U);
  for (const float scale : {0x1p-66F, 0x1p+66F}) {  // 1e-20 and 1e20, exact
    const Case scaled{"scaled", PointsXyz::Ptr(new PointsXyz(*usual.cloud)), nullptr, {}};
    for (pcl::PointXYZ& p : *scaled.cloud)
      p.getArray3fMap() *= scale;
    EXPECT_TRUE(clusters_by(std::make_shared<Ours>(false), scaled, 0.25F * scale) == expected);
  }
}

template <typename Estimation>
pcl::PointCloud<pcl::Normal> normals_by(Estimation estimation, const SearchXyz::Ptr& tree, const Case& one,
                                        int k, double radius) {
  estimation.setInputCloud(one.cloud);
  if (one.indices) estimation.setIndices(one.indices);
  estimation.setSearchMethod(tree);
  estimation.setKSearch(k);
  estimation.setRadiusSearch(radius);
  pcl::PointCloud<pcl::Normal> normals;
  estimation.compute(normals);
  return normals;
}

bool same(const pcl::Normal& a, const pcl::Normal& b) {
  return std::memcmp(a.data_n, b.data_n, 3 * sizeof(float)) == 0 && a.curvature == b.curvature;
}

// Where the neighbours come in the same order (equally far ones may not) normals are equal to the last bit.
void expect_same_normals(const Case& one, int k, double radius) {
  SCOPED_TRACE(one.name);
  const auto ours = std::make_shared<Ours>(), all_ours = std::make_shared<Ours>();
  const auto theirs = std::make_shared<Theirs>();
  using Estimation = pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal>;
  const auto a = normals_by(Estimation(), ours, one, k, radius);
  const auto b = normals_by(Estimation(), theirs, one, k, radius);
  const auto c =
      normals_by(pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal>(3), all_ours, one, k, radius);
  ASSERT_EQ(a.size(), b.size());
  ASSERT_EQ(a.size(), c.size());
  std::size_t in_order = 0, with_normal = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto point = static_cast<int>(one.indices ? static_cast<std::size_t>((*one.indices)[i]) : i);
    with_normal += pcl::isNormalFinite(a[i]);
    ASSERT_EQ(pcl::isNormalFinite(a[i]), pcl::isNormalFinite(c[i]));
    ASSERT_TRUE(!pcl::isNormalFinite(a[i]) || same(a[i], c[i])) << i;
    if (!pcl::isFinite((*one.cloud)[static_cast<std::size_t>(point)])) continue;
    const Answer mine = k > 0 ? nearest(*ours, point, k) : within(*ours, point, radius);
    const Answer pcls = k > 0 ? nearest(*theirs, point, k) : within(*theirs, point, radius);
    if (mine.indices != pcls.indices) continue;
    ++in_order;
    ASSERT_EQ(pcl::isNormalFinite(a[i]), pcl::isNormalFinite(b[i]));
    ASSERT_TRUE(!pcl::isNormalFinite(a[i]) || same(a[i], b[i])) << i;
  }
  EXPECT_GT(with_normal, a.size() / 2);
  EXPECT_GT(in_order, a.size() * 8 / 10);
}

TEST(PointTreeSearchAsPcl, GivesNormalEstimationTheSameNormals) {
  const PointsXyz::Ptr sweep = street(16'000);
  const PointsXyz::Ptr holes(new PointsXyz(*uniform(3000, 1, 7)));
  for (std::size_t i = 0; i < holes->size(); i += 9)
    (*holes)[i].x = std::numeric_limits<float>::quiet_NaN();
  holes->is_dense = false;
  for (const Case& one :
       {Case{"uniform", uniform(3000, 1, 8), nullptr, {}}, Case{"holes", holes, nullptr, {}},
        Case{"street", sweep, nullptr, {}}, Case{"part of a street", sweep, every(2, sweep->size()), {}}}) {
    expect_same_normals(one, 12, 0);
    expect_same_normals(one, 0, 0.5);
  }
}

// What pcl::StatisticalOutlierRemoval does, which takes no tree of others: the mean distance of k neighbours.
std::vector<double> mean_distances(const SearchXyz& tree, int size, int k) {
  std::vector<double> means;
  for (int i = 0; i < size; ++i) {
    const Answer found = nearest(tree, i, k + 1);
    double sum = 0;
    for (const float square : found.squares)
      sum += std::sqrt(double{square});
    means.push_back(sum / k);
  }
  return means;
}

TEST(PointTreeSearchAsPcl, GivesStatisticsOfOutliersTheSameDistances) {
  for (const Case& one : cases()) {
    if (one.cloud->size() < 100) continue;
    SCOPED_TRACE(one.name);
    const int size = static_cast<int>(one.indices ? one.indices->size() : one.cloud->size());
    const std::vector<double> ours = mean_distances(*tree_of<Ours>(one), size, 20);
    const std::vector<double> theirs = mean_distances(*tree_of<Theirs>(one), size, 20);
    for (std::size_t i = 0; i < ours.size(); ++i)
      ASSERT_NEAR(ours[i], theirs[i], kFloatError * ours[i]);
  }
}

}  // namespace
}  // namespace pcl_bv::detail
