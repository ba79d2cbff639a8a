// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/segmentation/class_clusters.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>

#include "pcl_bv/parallel/execution.h"
#include "reference.h"

namespace pcl_bv::detail {
namespace {

using test::Cloud;
using test::ClusterList;
using test::view_of;

struct Found {
  Clusters clusters;
  std::vector<std::int64_t> class_of;
};

template <typename T>
Found by_class(const Cloud<T>& cloud, const std::vector<std::int64_t>& classes, const ClusterOptions& others,
               const std::vector<ClassOptions>& own = {}, const ParallelPolicy& policy = Serial{}) {
  Found found;
  ClassClusterer().extract(view_of(cloud), classes, others, own, found.clusters, found.class_of, policy);
  return found;
}

template <typename T>
class ClassClusters : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(ClassClusters, Scalars);

TYPED_TEST(ClassClusters, AreThoseOfEachClassAlone) {
  const std::int64_t values[] = {-7, 0, 3, std::int64_t{1} << 40};
  for (unsigned seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    const auto cloud = test::uniform_cloud<TypeParam>(600, 1, seed);
    std::vector<std::int64_t> classes;
    for (std::size_t i = 0; i < cloud.size(); ++i)
      classes.push_back(values[random() % 4]);
    std::vector<std::pair<std::vector<std::int32_t>, std::int64_t>> expected;
    for (const std::int64_t value : values) {
      Cloud<TypeParam> alone;
      std::vector<std::int32_t> numbers;
      for (std::size_t i = 0; i < cloud.size(); ++i) {
        if (classes[i] != value) continue;
        alone.push_back(cloud[i]);
        numbers.push_back(static_cast<std::int32_t>(i));
      }
      for (const auto& places : test::brute_force(alone, value == 3 ? 0.4F : 0.2F)) {
        if (places.size() < (value == 3 ? 5U : 2U)) continue;
        auto& entry = expected.emplace_back(std::vector<std::int32_t>(), value);
        for (const std::int32_t place : places)
          entry.first.push_back(numbers[static_cast<std::size_t>(place)]);
      }
    }
    std::sort(expected.begin(), expected.end(), [](const auto& a, const auto& b) {
      return a.first.size() != b.first.size() ? a.first.size() > b.first.size()
                                              : a.first.front() < b.first.front();
    });
    for (const ParallelPolicy& policy : {ParallelPolicy(Serial{}), ParallelPolicy(Threads{3})}) {
      const Found found = by_class(cloud, classes, {0.2F, 2}, {{3, {0.4F, 5}}}, policy);
      ASSERT_EQ(found.clusters.size(), expected.size());
      ASSERT_EQ(found.class_of.size(), expected.size());
      const ClusterList lists = test::as_lists(found.clusters);
      std::size_t inside = 0;
      for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_EQ(lists[i], expected[i].first) << i;
        EXPECT_EQ(found.class_of[i], expected[i].second) << i;
        inside += lists[i].size();
      }
      EXPECT_EQ(inside + found.clusters.small_points, cloud.size());
    }
  }
}

const Cloud<float> kRow{{0, 0, 0}, {0.1F, 0, 0}, {0.2F, 0, 0}, {0.3F, 0, 0}};

TEST(ClassClusters, OfADroppedClassThereAreNone) {
  const Found found = by_class(kRow, {1, 1, 2, 2}, {1}, {{2, {1}, true}});
  ASSERT_EQ(found.clusters.size(), 1U);
  EXPECT_EQ(found.clusters.list_size(0), 2U);
  EXPECT_EQ(found.class_of, std::vector<std::int64_t>{1});
  EXPECT_EQ(found.clusters.small_points, 0U);
  EXPECT_EQ(found.clusters.class_points, 2U);
}

TEST(ClassClusters, OfADroppedClassCountValidPointsOnly) {
  Cloud<float> cloud = kRow;
  cloud[3][0] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(by_class(cloud, {1, 1, 2, 2}, {1}, {{2, {1}, true}}).clusters.class_points, 1U);
  EXPECT_EQ(by_class(cloud, {1, 1, 2, 2}, {1}).clusters.class_points, 0U);
}

TEST(ClassClusters, CountEachClassBySettingsOfItsOwn) {
  const Found found = by_class(kRow, {1, 2, 2, 3}, {0.15F, 2}, {{2, {0.15F, 1, 1}}, {3, {0.15F, 1, 9, 2}}});
  EXPECT_EQ(found.clusters.size(), 0U);
  EXPECT_EQ(found.clusters.small_points, 1U);
  EXPECT_EQ(found.clusters.large_points, 2U);
  EXPECT_EQ(found.clusters.noise_points, 1U);
}

TEST(ClassClusters, OfAnIndexListLookUpClassesByPointNumber) {
  const std::int32_t list[] = {3, 1, 3};
  PointView view = view_of(kRow);
  view.indices = list;
  view.count = 3;
  Found found;
  ClassClusterer().extract(view, {9, 5, 9, 5}, {1}, {}, found.clusters, found.class_of);
  ASSERT_EQ(test::as_lists(found.clusters), (ClusterList{{1, 3}}));
  EXPECT_EQ(found.class_of, std::vector<std::int64_t>{5});
}

TYPED_TEST(ClassClusters, OfASliceAreThoseOfItsIndexList) {
  const auto cloud = test::uniform_cloud<TypeParam>(600, 1, 4);
  const PointView points = view_of(cloud);
  std::vector<std::int64_t> classes(cloud.size());
  for (std::size_t i = 0; i < classes.size(); ++i)
    classes[i] = static_cast<std::int64_t>(i % 3);
  std::vector<std::int32_t> list(250);
  std::iota(list.begin(), list.end(), 200);
  Found expected, found;
  const std::vector<ClassOptions> own = {{1, {0.3F, 2}}, {2, {0.2F}, true}};
  ClassClusterer().extract(points.subset(list), classes, {0.2F, 2}, own, expected.clusters,
                           expected.class_of);
  ClassClusterer().extract(points.slice(200, 250), classes, {0.2F, 2}, own, found.clusters, found.class_of);
  ASSERT_GT(expected.clusters.size(), 2U);
  EXPECT_EQ(found.clusters.indices, expected.clusters.indices);
  EXPECT_EQ(found.clusters.offsets, expected.clusters.offsets);
  EXPECT_EQ(found.class_of, expected.class_of);
  EXPECT_EQ(found.clusters.class_points, expected.clusters.class_points);
}

TEST(ClassClusters, OfNoPointsAreNone) {
  Found found = by_class(kRow, {1, 1, 1, 1}, {1});
  ASSERT_EQ(found.clusters.size(), 1U);
  ClassClusterer().extract(PointView(), {}, {1}, {}, found.clusters, found.class_of);
  EXPECT_EQ(found.clusters.size(), 0U);
  EXPECT_TRUE(found.class_of.empty());
}

TEST(ClassClusters, RefuseAClassWithSettingsTwiceAndAPointWithout) {
  const auto message = [](const std::vector<std::int64_t>& classes, const ClusterOptions& others,
                          const std::vector<ClassOptions>& own) -> std::string {
    try {
      by_class(kRow, classes, others, own);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message({1, 1, 1, 1}, {1}, {{1, {1}}, {1, {2}}}), "class 1 has two entries in the settings");
  EXPECT_EQ(message({1, 1, 1}, {1}, {}), "point 3 has no class: there are classes for 3 points");
  EXPECT_EQ(message({1, 1, 1, 1}, {-1}, {{1, {1}}}),
            "cluster tolerance is -1, must be finite and greater than 0");
}

}  // namespace
}  // namespace pcl_bv::detail
