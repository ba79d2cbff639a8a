// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What becomes of clusters above the greatest size.
#include <gtest/gtest.h>

#include <numeric>

#include "dbscan_reference.h"
#include "pcl_bv/parallel/execution.h"

namespace pcl_bv::detail {
namespace {

using test::Cloud;
using test::ClusterList;
using test::view_of;

Clusters extract(const Cloud<float>& cloud, const ClusterOptions& settings,
                 const ParallelPolicy& policy = Serial{}) {
  Clusters clusters;
  EuclideanClusterer().extract(view_of(cloud), settings, clusters, policy);
  return clusters;
}

struct Expected {
  ClusterList clusters;
  std::size_t small = 0, large = 0, noise = 0;
};

// Clusters of the points by definition, those that are too large again with half the tolerance.
void split(const Cloud<float>& cloud, const std::vector<std::int32_t>& points, ClusterOptions settings,
           int halvings, Expected& expected) {
  Cloud<float> part;
  for (const std::int32_t i : points)
    part.push_back(cloud[static_cast<std::size_t>(i)]);
  const test::Dbscan found = test::dbscan(part, settings.tolerance, settings.min_points);
  expected.noise += found.noise;
  for (const auto& places : found.clusters) {
    std::vector<std::int32_t> numbers;
    for (const std::int32_t place : places)
      numbers.push_back(points[static_cast<std::size_t>(place)]);
    if (numbers.size() < settings.min_size) {
      expected.small += numbers.size();
    } else if (numbers.size() <= settings.max_size) {
      expected.clusters.push_back(numbers);
    } else if (halvings == 0) {
      expected.large += numbers.size();
    } else {
      ClusterOptions finer = settings;
      finer.tolerance /= 2;
      split(cloud, numbers, finer, halvings - 1, expected);
    }
  }
}

Expected split(const Cloud<float>& cloud, const ClusterOptions& settings) {
  std::vector<std::int32_t> all;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    all.push_back(static_cast<std::int32_t>(i));
  Expected expected;
  split(cloud, all, settings, 3, expected);
  std::sort(expected.clusters.begin(), expected.clusters.end(), [](const auto& a, const auto& b) {
    return a.size() != b.size() ? a.size() > b.size() : a.front() < b.front();
  });
  return expected;
}

TEST(Oversized, PartsAreTheClustersOfHalfTheToleranceUpToThreeTimes) {
  std::size_t kinds = 0;  // cases in which something is split, dropped as large, as small and as noise
  for (unsigned seed = 0; seed < 10; ++seed) {
    const Cloud<float> cloud = test::uniform_cloud<float>(800, 1, seed);
    for (const float tolerance : {0.3F, 2.0F}) {
      for (const std::size_t min_points : {1U, 4U}) {
        SCOPED_TRACE(testing::Message()
                     << "seed " << seed << ", tolerance " << tolerance << ", " << min_points);
        ClusterOptions settings{tolerance, 3, 40, min_points};
        settings.oversized = Oversized::split;
        const Expected expected = split(cloud, settings);
        for (const ParallelPolicy& policy : {ParallelPolicy(Serial{}), ParallelPolicy(Threads{2})}) {
          const Clusters found = extract(cloud, settings, policy);
          EXPECT_EQ(test::as_lists(found), expected.clusters);
          EXPECT_EQ(found.small_points, expected.small);
          EXPECT_EQ(found.large_points, expected.large);
          EXPECT_EQ(found.noise_points, expected.noise);
        }
        if (expected.clusters.size() > 1) kinds |= 1;
        if (expected.large > 0) kinds |= 2;
        if (expected.small > 0) kinds |= 4;
        if (expected.noise > 0) kinds |= 8;
      }
    }
  }
  EXPECT_EQ(kinds, 15U);
}

TEST(Oversized, TwoBlocksWithABridgeOfFewPointsAreTwo) {
  Cloud<float> cloud;
  for (int i = 0; i < 100; ++i) {
    cloud.push_back({0.05F * static_cast<float>(i % 10), 0.05F * static_cast<float>(i / 10), 0});
    cloud.push_back({2 + 0.05F * static_cast<float>(i % 10), 0.05F * static_cast<float>(i / 10), 0});
  }
  for (int i = 1; i < 5; ++i)
    cloud.push_back({0.45F + 0.31F * static_cast<float>(i), 0.2F, 0});
  ClusterOptions settings{0.4F, 10, 150};
  EXPECT_EQ(extract(cloud, settings).large_points, 204U);
  settings.oversized = Oversized::keep;
  const Clusters kept = extract(cloud, settings);
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_EQ(kept.list_size(0), 204U);
  EXPECT_EQ(kept.large_points, 0U);
  settings.oversized = Oversized::split;
  const Clusters parts = extract(cloud, settings);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts.list_size(0), 100U);
  EXPECT_EQ(parts.list_size(1), 100U);
  EXPECT_EQ(parts.small_points, 4U);
}

TEST(Oversized, PartsOfASliceAreThoseOfItsIndexList) {
  const Cloud<float> cloud = test::uniform_cloud<float>(900, 1, 3);
  const PointView points = test::view_of(cloud);
  std::vector<std::int32_t> list(400);
  std::iota(list.begin(), list.end(), 300);
  ClusterOptions options{0.3F, 2, 40};
  options.oversized = Oversized::split;
  const Clusters expected = cluster(points.subset(list), options);
  ASSERT_GT(expected.size(), 1U);
  const Clusters found = cluster(points.slice(300, 400), options);
  EXPECT_EQ(found.indices, expected.indices);
  EXPECT_EQ(found.offsets, expected.offsets);
}

TEST(Oversized, PartsOfAToleranceThatGrowsHalveItAtEveryRange) {
  const auto pair = [](float apart) {
    return Cloud<float>{{100, 0, 0}, {100 + apart, 0, 0}, {100, 0.1F, 0}};
  };
  ClusterOptions settings{0.5F, 1, 2};
  settings.tolerance_per_metre = 0.01F;  // 2^(6/4) * 0.5 m there, and half of that, and a quarter
  settings.oversized = Oversized::split;
  EXPECT_EQ(extract(pair(1.2F), settings).size(), 2U);
  EXPECT_EQ(extract(pair(0.9F), settings).size(), 2U);  // not if only the tolerance at the origin were halved
  const Clusters together = extract(pair(0.1F), settings);
  EXPECT_EQ(together.size(), 0U);
  EXPECT_EQ(together.large_points, 3U);
}

}  // namespace
}  // namespace pcl_bv::detail
