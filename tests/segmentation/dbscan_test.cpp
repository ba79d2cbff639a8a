// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clusters with min_points > 1 against DBSCAN's definition.
#include <gtest/gtest.h>

#include <limits>
#include <numeric>
#include <stdexcept>

#include "dbscan_reference.h"
#include "pcl_bv/parallel/execution.h"

namespace pcl_bv::detail {
namespace {

using test::Cloud;
using test::ClusterList;
using test::lattice;
using test::uniform_cloud;
using test::view_of;

Clusters dbscan(const PointView& points, float tolerance, std::size_t min_points,
                const ParallelPolicy& policy = Serial{}) {
  ClusterOptions settings{tolerance};
  settings.min_points = min_points;
  Clusters clusters;
  EuclideanClusterer().extract(points, settings, clusters, policy);
  return clusters;
}

template <typename T>
void expect_dbscan(const Cloud<T>& cloud, float tolerance, std::size_t min_points) {
  SCOPED_TRACE(testing::Message() << cloud.size() << " points, tolerance " << tolerance << ", min_points "
                                  << min_points);
  const test::Dbscan expected = test::dbscan(cloud, tolerance, min_points);
  const Clusters found = dbscan(view_of(cloud), tolerance, min_points);
  EXPECT_EQ(test::as_lists(found), expected.clusters);
  EXPECT_EQ(found.noise_points, expected.noise);
}

TEST(Dbscan, EqualsItsDefinitionOnRandomPoints) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    const Cloud<float> cloud = uniform_cloud(700, 1.F, seed);
    for (const float r : {0.02F, 0.1F, 0.15F, 0.2F, 0.3F, 0.5F, 4.F}) {
      for (const std::size_t min_points : {2U, 3U, 5U, 9U, 20U, 200U, 700U, 701U})
        expect_dbscan(cloud, r, min_points);
    }
  }
}

// Cells with more than 64 points, and one with more than 1024, are searched through a tree of boxes.
TEST(Dbscan, EqualsItsDefinitionWhereCellsHaveTreesOfBoxes) {
  Cloud<double> cloud = uniform_cloud(1100, 0.05, 3);
  for (const auto& p : uniform_cloud(1900, 0.4, 4))
    cloud.push_back(p);
  for (int i = 0; i < 100; ++i)
    cloud.push_back(cloud[static_cast<std::size_t>(7 * i)]);
  for (const std::size_t min_points : {10U, 100U, 900U, 1500U, 2500U})
    expect_dbscan(cloud, 0.3F, min_points);
}

TEST(Dbscan, CountsNoPointAtExactlyTheTolerance) {
  const Cloud<float> line{{0, 0, 0}, {0.5F, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(dbscan(view_of(line), 0.5F, 2).noise_points, 3U);
  EXPECT_EQ(dbscan(view_of(line), std::nextafter(0.5F, 1.F), 2).size(), 1U);
}

TEST(Dbscan, EqualsItsDefinitionWhereCellsHoldManyPoints) {
  Cloud<float> cloud = uniform_cloud(900, 0.3F, 1);
  for (const auto& p : uniform_cloud(300, 2.F, 2))
    cloud.push_back(p);
  for (const float r : {0.2F, 0.5F, 1.F}) {
    for (const std::size_t min_points : {4U, 40U, 150U, 400U, 900U})
      expect_dbscan(cloud, r, min_points);
  }
}

// The points around a point are compared all at once up to 1024, and group by group above. Here the own block
// of a point has fewer, and with other blocks there are more.
template <typename T>
void expect_dbscan_across_blocks(T offset) {
  Cloud<T> cloud;
  for (const auto& p : uniform_cloud<T>(900, T(0.3), 11, {offset, 0, 0}))
    cloud.push_back(p);
  for (const auto& p : uniform_cloud<T>(900, T(0.3), 12, {offset + T(0.7), 0, 0}))
    cloud.push_back(p);
  for (const std::size_t min_points : std::vector<std::size_t>{20, 950, 1400, 1801, SIZE_MAX})
    expect_dbscan(cloud, 1.F, min_points);
}

TEST(Dbscan, EqualsItsDefinitionWhereOtherBlocksHaveThousandPointsMore) {
  for (const double offset : {0., 0.4, 0.9, 1.3}) {
    SCOPED_TRACE(offset);
    expect_dbscan_across_blocks<float>(static_cast<float>(offset));
    expect_dbscan_across_blocks<double>(offset);
  }
}

TEST(Dbscan, TakesPointsAtExactlyTheToleranceForApart) {
  for (const std::size_t min_points : {2U, 7U, 8U, 19U, 20U, 27U, 28U}) {
    for (const float r : {0.25F, 0.250001F, 0.36F, 0.5F})
      expect_dbscan(lattice(7, 0.25F), r, min_points);
  }
  const Cloud<float> cloud = lattice(7, 0.25F);
  EXPECT_EQ(dbscan(view_of(cloud), 0.25F, 2).noise_points, cloud.size());
  EXPECT_EQ(dbscan(view_of(cloud), 0.2500001F, 4).noise_points, 0U);
}

TEST(Dbscan, GivesABorderPointToTheNearestCorePointThenToTheFirst) {
  // Two groups of four duplicates; between them a point that is near enough to both, but not core.
  Cloud<float> cloud{{0.75F, 0, 0}};
  for (int i = 0; i < 4; ++i) {
    cloud.push_back({1.5F, 0, 0});
    cloud.push_back({0, 0, 0});
  }
  const auto with_border = [&](float x) {
    cloud[0][0] = x;
    return test::as_lists(dbscan(view_of(cloud), 1.F, 10)).size();
  };
  EXPECT_EQ(with_border(0.75F), 0U);  // All are noise: the border point has nine.
  const auto border_of = [&](float x) {
    cloud[0][0] = x;
    cloud.resize(9);
    cloud.insert(cloud.end(), 8, {1.5F + 0.8F, 0, 0});  // makes the right ones core,
    cloud.insert(cloud.end(), 8, {-0.8F, 0, 0});        // and the left ones
    const ClusterList lists = test::as_lists(dbscan(view_of(cloud), 1.F, 10));
    EXPECT_EQ(lists.size(), 2U);
    return lists.front();
  };
  EXPECT_EQ(border_of(0.75F)[1], 1);  // equally near: the cluster of point 1
  EXPECT_EQ(border_of(0.74F)[1], 2);
  EXPECT_EQ(border_of(0.76F)[1], 1);
}

TEST(Dbscan, CountsAPointItselfAndItsDuplicates) {
  const Cloud<float> cloud(5, {1, 2, 3});
  EXPECT_EQ(dbscan(view_of(cloud), 0.1F, 5).size(), 1U);
  EXPECT_EQ(dbscan(view_of(cloud), 0.1F, 6).noise_points, 5U);
  EXPECT_EQ(dbscan(view_of(cloud), 1e-30F, 2).noise_points, 5U);  // Its square is 0: not even duplicates.
  EXPECT_EQ(dbscan(view_of(cloud), 1e-30F, 1).size(), 5U);
}

TEST(Dbscan, SkipsPointsThatAreNotFinite) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  Cloud<float> cloud = uniform_cloud(300, 1.F, 3);
  for (std::size_t i = 0; i < cloud.size(); i += 7)
    cloud[i][i % 3] = nan;
  for (const std::size_t min_points : {2U, 4U, 8U})
    expect_dbscan(cloud, 0.3F, min_points);
}

TEST(Dbscan, HoldsForDoublesFarFromTheOrigin) {
  const Cloud<double> utm = uniform_cloud<double>(500, 1, 4, {4e5, 5e6, 100});
  const Cloud<double> tiny = uniform_cloud<double>(500, 1e-8, 5, {4e5, 5e6, 100});  // cells that may be apart
  for (const std::size_t min_points : {2U, 4U, 10U, 50U}) {
    for (const float r : {0.1F, 0.25F, 0.6F})
      expect_dbscan(utm, r, min_points);
    for (const float r : {1e-9F, 2.5e-9F, 6e-9F})
      expect_dbscan(tiny, r, min_points);
  }
}

TEST(Dbscan, HoldsNearTheSmallestAndTheLargestSquares) {
  for (const std::size_t min_points : {2U, 5U, 20U}) {
    expect_dbscan(uniform_cloud(300, 1e-22F, 6), 3e-23F, min_points);
    expect_dbscan(uniform_cloud(300, 1e19F, 7), 3e18F, min_points);
    expect_dbscan(uniform_cloud(300, 1e38F, 8), 3e37F, min_points);
  }
  Cloud<float> wide = uniform_cloud(300, 1.F, 9);  // keys beyond 64 bits
  wide.push_back({3e37F, -3e37F, 3e37F});
  expect_dbscan(wide, 0.3F, 5);
}

TEST(Dbscan, HasTheSameCorePartitionWhateverTheOrderOfThePoints) {
  const Cloud<float> cloud = uniform_cloud(2000, 1.F, 10);
  std::vector<std::int32_t> order(cloud.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(11));
  Cloud<float> shuffled;
  for (const std::int32_t i : order)
    shuffled.push_back(cloud[static_cast<std::size_t>(i)]);
  for (const std::size_t min_points : {3U, 6U}) {
    ClusterList lists = test::as_lists(dbscan(view_of(shuffled), 0.13F, min_points));
    for (auto& list : lists) {
      for (std::int32_t& i : list)
        i = order[static_cast<std::size_t>(i)];
      std::sort(list.begin(), list.end());
    }
    ClusterList expected = test::as_lists(dbscan(view_of(cloud), 0.13F, min_points));
    std::sort(lists.begin(), lists.end());
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(lists, expected);
    EXPECT_GT(lists.size(), 5U);
  }
}

TEST(Dbscan, CountsNoiseApartFromSmallAndLargeClusters) {
  Cloud<float> cloud(6, {0, 0, 0});
  cloud.insert(cloud.end(), 9, {5, 0, 0});
  cloud.insert(cloud.end(), 4, {10, 0, 0});
  cloud.insert(cloud.end(), 2, {15, 0, 0});
  ClusterOptions settings{1.F, 5, 8};
  settings.min_points = 3;
  Clusters clusters;
  EuclideanClusterer().extract(view_of(cloud), settings, clusters);
  EXPECT_EQ(clusters.size(), 1U);
  EXPECT_EQ(clusters.large_points, 9U);
  EXPECT_EQ(clusters.small_points, 4U);
  EXPECT_EQ(clusters.noise_points, 2U);
}

TEST(Dbscan, RefusesNoPointAsCoreCondition) {
  const Cloud<float> cloud(5, {1, 2, 3});
  try {
    dbscan(view_of(cloud), 1.F, 0);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "cluster min_points is 0, must be at least 1");
  }
}

}  // namespace
}  // namespace pcl_bv::detail
