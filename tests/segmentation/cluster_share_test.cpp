// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clusters of shares, when they are joined, are those of the whole cloud.

#include "pcl_bv/segmentation/cluster_share.h"

#include <gtest/gtest.h>

#include <map>
#include <numeric>

#include "share_scenes.h"

namespace pcl_bv::detail {
namespace {

// A cluster that is a component of a share has the points of that component.
void expect_components_to_match(const Shares& shares, ClusterOptions options, const StoredClusters& joined) {
  options.min_size = 1;
  options.oversized = Oversized::keep;
  for (std::size_t s = 0; s < shares.size(); ++s) {
    const StoredClusters alone({shares[s].get()}, options);
    std::map<std::uint32_t, std::size_t> number;  // of the component, to the number in `alone`
    for (std::size_t i = 0; i < alone.size(); ++i)
      number[alone.component(i).value().number] = i;
    EXPECT_EQ(number.size(), shares[s]->components().size());
    const ClusterBytes of_share = bytes_of(alone), of_all = bytes_of(joined);
    for (std::size_t i = 0; i < joined.size(); ++i) {
      const auto component = joined.component(i);
      if (component && component->share == s) {
        EXPECT_EQ(of_all[i], of_share[number.at(component->number)]);
      }
    }
  }
}

// The points of clusters have their labels, and all valid points have their check sums.
void expect_labels(const PointView& cloud, const Clusters& expected, const StoredClusters& joined) {
  std::vector<std::uint32_t> labels(cloud.count, StoredClusters::kNoCluster), sums(cloud.count);
  for (std::size_t c = 0; c < expected.size(); ++c)
    for (std::size_t i = 0; i < expected.list_size(c); ++i)
      labels[expected.list(c)[i]] = static_cast<std::uint32_t>(c);
  for (std::size_t i = 0; i < cloud.count; ++i)
    if (is_valid(load_point(cloud, i))) sums[i] = point_check_sum(cloud.address(i), cloud.scalar);
  EXPECT_EQ(joined.labels(0, cloud.count), labels);
  EXPECT_EQ(joined.check_sums(0, cloud.count), sums);
}

template <typename T>
class ClusterSharesOf : public testing::Test {};
using ScalarTypes = testing::Types<float, double>;
TYPED_TEST_SUITE(ClusterSharesOf, ScalarTypes);

TYPED_TEST(ClusterSharesOf, AreJoinedToThoseOfTheWholeCloudForAnyTilingAndOrder) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    test::TestCloud<TypeParam> cloud = scene<TypeParam>(seed);
    std::mt19937_64 random(seed);
    const std::vector<std::size_t> ends = make_tiles(random, cloud);
    const ClusterOptions options = random_options(random);
    SCOPED_TRACE(testing::Message() << cloud.name << ", min_points " << options.min_points << ", tolerance "
                                    << options.tolerance);
    const std::size_t in_memory = std::array{1U, 40U, 1U << 20U}[random() % 3];
    Shares shares;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      const bool own_numbers = seed % 2 == 0;
      PointView part = cloud.view().slice(ends[i], ends[i + 1] - ends[i]);
      if (own_numbers) part.first = 0;
      shares.push_back(
          std::make_unique<MadeClusterShare>(part, options, StoredClusterOptions{in_memory, {}}));
      if (own_numbers) shares.back()->first_number = ends[i];
    }
    std::shuffle(shares.begin(), shares.end(), random);
    StoredClusterOptions store{in_memory, {}};
    store.has_labels = true;
    store.points_of_shares = cloud.size();
    const StoredClusters joined(pointers(shares), options, store);
    const Clusters expected = cluster(cloud.view(), options);
    EXPECT_EQ(bytes_of(joined), bytes_of(cloud.view(), expected));
    EXPECT_EQ(joined.counts().small, expected.small_points);
    EXPECT_EQ(joined.counts().large, expected.large_points);
    EXPECT_EQ(joined.counts().noise, expected.noise_points);
    expect_labels(cloud.view(), expected, joined);
    expect_components_to_match(shares, options, joined);
    if (testing::Test::HasFailure()) return;
  }
}

TYPED_TEST(ClusterSharesOf, AreJoinedToThoseOfTheWholeCloudOnNastyClouds) {
  for_each_nasty_clustering<TypeParam>([](const PointView& points, const ClusterOptions& options) {
    const std::size_t half = points.count / 2;
    Shares shares;
    shares.push_back(std::make_unique<MadeClusterShare>(points.slice(0, half), options));
    shares.push_back(std::make_unique<MadeClusterShare>(points.slice(half, points.count - half), options));
    EXPECT_EQ(bytes_of(StoredClusters(pointers(shares), options)),
              bytes_of(points, cluster(points, options)));
  });
}

TEST(ClusterShares, SayWhichClustersAreComponentsOfAShareAndDoNotReadThosePoints) {
  const test::TestCloud<float> cloud = two_clumps_and_a_line();
  ClusterOptions options;
  options.tolerance = 0.5F;
  std::size_t visited = 0;
  StoredClusterOptions store;
  store.visit = [&](std::size_t, const std::vector<PointView>& clusters, const Execution&) {
    visited += clusters.size();
  };
  Shares shares;
  shares.push_back(std::make_unique<MadeClusterShare>(cloud.view().slice(0, 150), options, store));
  shares.push_back(std::make_unique<MadeClusterShare>(cloud.view().slice(150, 150), options, store));
  EXPECT_EQ(visited, 4U);
  StoredClusterOptions known;
  known.is_known = [&](const ComponentOfShare& c) { return shares[c.share]->visit(c.number).has_value(); };
  const StoredClusters joined(pointers(shares), options, known);
  ASSERT_EQ(joined.size(), 3U);
  EXPECT_EQ(
      joined.component(0).has_value() + joined.component(1).has_value() + joined.component(2).has_value(), 2);
}

TEST(ClusterShares, OfMoreRunsThanAreReadAtATimeKeepTheOrderOfTheCloud) {
  test::TestCloud<float> cloud{"a line in any order", {}};
  std::vector<float> along(8000);
  std::iota(along.begin(), along.end(), 0.0F);
  std::mt19937_64 random(1);
  std::shuffle(along.begin(), along.end(), random);
  for (const float x : along)
    cloud.xyz.insert(cloud.xyz.end(), {x, 0, 0});
  ClusterOptions options;
  options.tolerance = 1.01F;
  Shares shares;
  for (const std::size_t first : {0U, 4000U})
    shares.push_back(std::make_unique<MadeClusterShare>(cloud.view().slice(first, 4000), options));
  EXPECT_GT(shares[0]->runs().size() + shares[1]->runs().size(), 2048U);
  EXPECT_EQ(bytes_of(StoredClusters(pointers(shares), options)),
            bytes_of(cloud.view(), cluster(cloud.view(), options)));
}

TEST(ClusterShares, WithNumbersBehindTheCloudAreNotLabelled) {
  const test::TestCloud<float> cloud = two_clumps_and_a_line();
  ClusterOptions options;
  options.tolerance = 0.5F;
  Shares shares;
  for (const std::size_t first : {0U, 150U})
    shares.push_back(std::make_unique<MadeClusterShare>(cloud.view().slice(first, 150), options));
  StoredClusterOptions store;
  store.has_labels = true;
  for (const std::uint64_t points : {299, 1, 0}) {
    store.points_of_shares = points;
    EXPECT_THROW(StoredClusters(pointers(shares), options, store), ShareError);
  }
  shares.front()->first_number = std::uint64_t{1} << 60;
  EXPECT_THROW(StoredClusters(pointers(shares), options, store), ShareError);
}

TEST(ClusterShares, OfNoPointAreNone) {
  ClusterOptions options;
  options.tolerance = 1;
  const MadeClusterShare none(PointView{}, options);
  EXPECT_EQ(StoredClusters({&none}, options).size(), 0U);
  EXPECT_EQ(StoredClusters(std::vector<const ClusterShare*>{}, options).size(), 0U);
}

}  // namespace
}  // namespace pcl_bv::detail
