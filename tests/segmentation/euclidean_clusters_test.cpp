// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The rules of the result: order, sizes, indices, bad points, bad settings, reuse.
#include "pcl_bv/segmentation/clusters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numeric>
#include <stdexcept>

#include "reference.h"

namespace {

using namespace pcl_bv;
using namespace pcl_bv::test;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(EuclideanClusters, FindsTheChainThatFecSplits) {
  // FEC never asks for the neighbours of a point that already has a label, and misses 0.9 - 1.7.
  const Cloud<float> cloud{{0.F, 0, 0}, {2.6F, 0, 0}, {0.9F, 0, 0}, {1.7F, 0, 0}};
  EXPECT_THAT(cluster(cloud, 1.F), ElementsAre(ElementsAre(0, 1, 2, 3)));
}

TEST(EuclideanClusters, LeavesPointsAtExactlyTheToleranceApart) {
  const Cloud<float> cloud{{0, 0, 0}, {0.5F, 0, 0}};
  EXPECT_THAT(cluster(cloud, 0.5F), ElementsAre(ElementsAre(0), ElementsAre(1)));
  EXPECT_THAT(cluster(cloud, 0.50001F), ElementsAre(ElementsAre(0, 1)));
}

TEST(EuclideanClusters, ComeLargestFirstThenBySmallestIndex) {
  const Cloud<float> cloud{{9, 0, 0},    {5, 0, 0},    {0, 0, 0},    {7, 0, 0},
                           {5.1F, 0, 0}, {7.1F, 0, 0}, {7.2F, 0, 0}, {0.1F, 0, 0}};
  EXPECT_THAT(cluster(cloud, 0.5F),
              ElementsAre(ElementsAre(3, 5, 6), ElementsAre(1, 4), ElementsAre(2, 7), ElementsAre(0)));
}

TEST(EuclideanClusters, CountThePointsOfDroppedClusters) {
  const Cloud<float> cloud{{0, 0, 0},    {5, 0, 0},    {5.1F, 0, 0}, {7, 0, 0},
                           {7.1F, 0, 0}, {7.2F, 0, 0}, {9, 0, 0}};
  Clusters clusters;
  EuclideanClusterer().extract(view_of(cloud), {0.5F, 2, 2}, clusters);
  EXPECT_THAT(as_lists(clusters), ElementsAre(ElementsAre(1, 2)));
  EXPECT_EQ(clusters.small_points, 2U);
  EXPECT_EQ(clusters.large_points, 3U);
}

TEST(EuclideanClusters, AreNoneBeforeAnyAreFound) {
  const Clusters clusters;
  EXPECT_EQ(clusters.size(), 0U);
  EXPECT_THAT(clusters.offsets, ElementsAre(0U));
  EXPECT_EQ(clusters.small_points, 0U);
  EXPECT_EQ(clusters.large_points, 0U);
  EXPECT_EQ(clusters.noise_points, 0U);
  EXPECT_EQ(clusters.class_points, 0U);
}

TEST(Counts, AreZeroUntilSomethingIsCounted) {
  const Counts counts;
  for (const std::size_t count :
       {counts.nonfinite, counts.range, counts.ground, counts.small, counts.large, counts.noise,
        counts.inside, counts.dropped_class, counts.cut, counts.joined})
    EXPECT_EQ(count, 0U);
}

TEST(EuclideanClusters, AreNoneWithoutValidPoints) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(cluster(Cloud<float>{}, 1.F), IsEmpty());
  EXPECT_THAT(cluster(Cloud<float>{{nan, 0, 0}, {0, INFINITY, 0}, {0, 0, -INFINITY}}, 1.F), IsEmpty());
}

TEST(EuclideanClusters, SkipPointsWithAnyCoordinateNotFinite) {
  Cloud<float> cloud = uniform_cloud(600, 1.F, 3);
  const float bad[] = {std::numeric_limits<float>::quiet_NaN(), INFINITY, -INFINITY};
  for (std::size_t i = 0; i < cloud.size(); i += 4)
    cloud[i][i % 3] = bad[i / 4 % 3];
  EXPECT_EQ(cluster(cloud, 0.1F), brute_force(cloud, 0.1F));
}

TEST(EuclideanClusters, OfALonePointAreOne) {
  EXPECT_THAT(cluster(Cloud<float>{{1, 2, 3}}, 1e-30F), ElementsAre(ElementsAre(0)));
}

TEST(EuclideanClusters, RefuseATolerance) {
  const Cloud<float> cloud{{0, 0, 0}};
  for (const float bad : {0.F, -1.F, INFINITY, std::numeric_limits<float>::quiet_NaN()}) {
    EXPECT_THROW(cluster(cloud, bad), std::invalid_argument) << bad;
  }
  try {
    cluster(cloud, -2.5F);
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_THAT(e.what(), testing::AllOf(testing::HasSubstr("-2.5"), testing::HasSubstr("greater than 0")));
  }
}

TEST(EuclideanClusters, RefuseAMinimumAboveTheMaximum) {
  const Cloud<float> cloud{{0, 0, 0}};
  Clusters clusters;
  EuclideanClusterer().extract(view_of(cloud), {1.F, 3, 3}, clusters);
  EXPECT_THROW(EuclideanClusterer().extract(view_of(cloud), {1.F, 4, 3}, clusters), std::invalid_argument);
}

TEST(EuclideanClusters, RefusePointNumbersBeyondInt32) {
  const float point[3] = {0, 0, 0};
  PointView view = PointView::of(point, 0, std::size_t{1} << 32);
  Clusters clusters;
  EXPECT_THROW(EuclideanClusterer().extract(view, {1.F}, clusters), std::length_error);
}

TEST(EuclideanClusters, DoNotDependOnTheOrderOfPoints) {
  const Cloud<float> cloud = uniform_cloud(1500, 1.F, 5);
  std::vector<std::int32_t> order(cloud.size());
  std::iota(order.begin(), order.end(), 0);
  const ClusterList expected = cluster(cloud, 0.09F);
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    std::shuffle(order.begin(), order.end(), std::mt19937(seed));
    Cloud<float> shuffled;
    for (const std::int32_t i : order)
      shuffled.push_back(cloud[i]);
    ClusterList found = cluster(shuffled, 0.09F);
    for (auto& list : found) {
      for (auto& i : list)
        i = order[i];
      std::sort(list.begin(), list.end());
    }
    EXPECT_THAT(found, testing::UnorderedElementsAreArray(expected));
  }
}

TEST(EuclideanClusters, OfAnIndexListAreThoseOfItsPoints) {
  const Cloud<float> cloud = uniform_cloud(1000, 1.F, 6);
  std::vector<std::int32_t> list;
  Cloud<float> chosen = cloud;  // NaN elsewhere, so that numbers stay
  for (std::int32_t i = 0; i < 1000; ++i) {
    if (i % 3 == 0) {
      chosen[i][0] = std::numeric_limits<float>::quiet_NaN();
    } else {
      list.push_back(i);
    }
  }
  const ClusterList expected = brute_force(chosen, 0.12F);
  PointView view = view_of(cloud);
  Clusters clusters;
  for (const char* order : {"ascending", "shuffled", "repeated"}) {
    SCOPED_TRACE(order);
    view.indices = list.data();
    view.count = list.size();
    EuclideanClusterer().extract(view, {0.12F}, clusters);
    EXPECT_EQ(as_lists(clusters), expected);
    std::shuffle(list.begin(), list.end(), std::mt19937(1));
    if (std::string_view(order) == "shuffled") list.insert(list.end(), list.begin(), list.begin() + 100);
  }
}

TEST(EuclideanClusters, OfASliceNameTheCloudsPoints) {
  const Cloud<float> cloud{{0, 0, 0}, {8, 0, 0}, {5, 0, 0}, {5.1F, 0, 0}, {0.1F, 0, 0}};
  Clusters clusters;
  EuclideanClusterer().extract(view_of(cloud).slice(1, 3), {0.5F}, clusters);
  EXPECT_THAT(as_lists(clusters), ElementsAre(ElementsAre(2, 3), ElementsAre(1)));
}

TEST(EuclideanClusters, OfUnalignedRecordsAreFound) {
  const Cloud<float> cloud = uniform_cloud(300, 1.F, 7);
  std::vector<std::byte> bytes(cloud.size() * 13 + 1);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    std::memcpy(&bytes[13 * i + 1], &cloud[i], 12);
  PointView view{bytes.data() + 1, 13, 12, cloud.size()};
  Clusters clusters;
  EuclideanClusterer().extract(view, {0.2F}, clusters);
  EXPECT_EQ(as_lists(clusters), brute_force(cloud, 0.2F));
}

TEST(EuclideanClusters, OfAUsedClustererAreThoseOfAFreshOne) {
  EuclideanClusterer used;
  Clusters clusters;
  for (unsigned seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const float tolerance = std::exp2(std::uniform_real_distribution<float>(-30.F, 1.F)(random));
    const auto count = std::uniform_int_distribution<std::size_t>(0, 3000)(random);
    const Cloud<float> cloud = uniform_cloud(count, 1.F, seed);
    const Cloud<double> doubles = uniform_cloud(count / 2, 1.0, seed);
    used.extract(view_of(cloud), {tolerance}, clusters);
    EXPECT_EQ(as_lists(clusters), cluster(cloud, tolerance));
    used.extract(view_of(doubles), {tolerance}, clusters);
    EXPECT_EQ(as_lists(clusters), cluster(doubles, tolerance));
  }
}

}  // namespace
