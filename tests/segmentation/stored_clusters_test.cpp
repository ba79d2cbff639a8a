// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clusters from bricks are those of the whole cloud in memory.

#include "pcl_bv/segmentation/stored_clusters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "stored_scenes.h"

namespace pcl_bv::detail {
namespace {

void expect_same_as_in_memory(const PointView& points, const ClusterOptions& options,
                              std::size_t points_in_memory, const Execution& execution = {}) {
  SCOPED_TRACE(testing::Message() << points_in_memory << " points in memory, min_points "
                                  << options.min_points << ", tolerance " << options.tolerance);
  const Clusters expected = cluster(points, options);
  StoredClusterOptions store{points_in_memory, {}};
  store.has_labels = true;
  const StoredClusters stored(points, options, store, execution);
  std::vector<std::uint32_t> labels(points.count, StoredClusters::kNoCluster);
  for (std::size_t c = 0; c < expected.size(); ++c)
    for (std::size_t i = 0; i < expected.list_size(c); ++i)
      labels[static_cast<std::size_t>(expected.list(c)[i])] = static_cast<std::uint32_t>(c);
  EXPECT_EQ(stored.labels(0, points.count), labels);
  EXPECT_EQ(bytes_of(stored), bytes_of(points, expected));
  EXPECT_EQ(stored.counts().small, expected.small_points);
  EXPECT_EQ(stored.counts().large, expected.large_points);
  EXPECT_EQ(stored.counts().noise, expected.noise_points);
  std::size_t valid = 0;
  for (std::size_t i = 0; i < points.count; ++i)
    valid += is_valid(load_point(points, i)) ? 1 : 0;
  EXPECT_EQ(stored.counts().nonfinite, points.count - valid);
}

template <typename T>
class StoredClustersOf : public testing::Test {};
using ScalarTypes = testing::Types<float, double>;
TYPED_TEST_SUITE(StoredClustersOf, ScalarTypes);

TYPED_TEST(StoredClustersOf, AreThoseOfTheWholeCloudForAnyBricks) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const test::TestCloud<TypeParam> cloud = scene<TypeParam>(seed);
    SCOPED_TRACE(cloud.name);
    std::mt19937_64 random(seed);
    const ClusterOptions options = random_options(random);
    for (const std::size_t in_memory : {1U, 40U, 700U, 1U << 20U})
      expect_same_as_in_memory(cloud.view(), options, in_memory);
    if (testing::Test::HasFailure()) return;
  }
}

TYPED_TEST(StoredClustersOf, AreThoseOfTheWholeCloudOnNastyClouds) {
  for_each_nasty_clustering<TypeParam>([](const PointView& points, const ClusterOptions& options) {
    expect_same_as_in_memory(points, options, 100);
  });
}

TEST(StoredClusters, OfOneClusterInAllBricksHaveAllItsPointsInOrder) {
  test::TestCloud<float> line{"line", {}};
  for (int i = 0; i < 100'000; ++i)
    line.xyz.insert(line.xyz.end(), {static_cast<float>(i * 7919 % 100'000) * 0.1F, 0, 0});
  ClusterOptions options;
  options.tolerance = 0.15F;
  const StoredClusters stored(line.view(), options, {1000, {}});
  ASSERT_EQ(stored.size(), 1U);
  ASSERT_GT(stored.point_count(0), kChunkPoints);
  expect_same_as_in_memory(line.view(), options, 1000, {Threads{3}});
}

TEST(StoredClusters, AreInBricksThoughTheFirstPointsAreFarAway) {
  test::TestCloud<double> cloud{"far points first", {}};
  for (const double far : {1e30, 0.0, -1e7})
    cloud.xyz.insert(cloud.xyz.end(), {far, far, far});
  for (int i = 0; i < 60'000; ++i)
    cloud.xyz.insert(cloud.xyz.end(), {5e5 + i % 300 * 0.3, 5.4e6 + i / 300 * 0.3, 100});
  ClusterOptions options;
  options.tolerance = 0.1F;
  EXPECT_GT(StoredClusters(cloud.view(), options, {1000, {}}).brick_count(), 50U);
  expect_same_as_in_memory(cloud.view(), options, 1000);
  options.tolerance = 0.4F;
  expect_same_as_in_memory(cloud.view(), options, 1000);
}

TEST(StoredClusters, OfNoValidPointAreNone) {
  ClusterOptions options;
  options.tolerance = 1;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> xyz = {nan, 0, 0, 1, nan, 0};
  for (const std::size_t count : {0, 2}) {
    const StoredClusters stored(PointView::of(xyz.data(), 12, count), options);
    EXPECT_EQ(stored.size(), 0U);
    EXPECT_EQ(stored.counts().nonfinite, count);
  }
}

TEST(StoredClusters, RefuseWhatTheyCannotFind) {
  const test::TestCloud<float> cloud = test::gaussian<float>(100, 1);
  ClusterOptions options;
  EXPECT_THROW(StoredClusters(cloud.view(), options), std::invalid_argument);
  options.tolerance = 1;
  options.tolerance_per_metre = 0.01F;
  EXPECT_THROW(StoredClusters(cloud.view(), options), std::invalid_argument);
  options.tolerance_per_metre = 0;
  options.oversized = Oversized::split;
  EXPECT_THROW(StoredClusters(cloud.view(), options), std::invalid_argument);
  options.oversized = Oversized::drop;
  const std::vector<std::int32_t> chosen = {1, 2};
  EXPECT_THROW(StoredClusters(cloud.view().subset(chosen), options), std::invalid_argument);
  EXPECT_THROW(StoredClusters(cloud.view(), options, {100, "/nowhere"}), std::runtime_error);
}

}  // namespace
}  // namespace pcl_bv::detail
