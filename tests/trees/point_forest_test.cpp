// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A forest answers as one tree of all its points.

#include "pcl_bv/trees/point_forest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "clouds.h"

namespace pcl_bv {
namespace {

template <typename T>
using Cloud = test::TestCloud<T>;

// With equal points, and some that are not valid. Doubles are not floats.
template <typename T>
Cloud<T> batch(std::size_t points, unsigned seed) {
  Cloud<T> cloud = test::gaussian<T>(points, seed, 3);
  for (T& x : cloud.xyz)
    x = std::round(x * 4) / 4 + (sizeof(T) == 8 ? T(0x1p-40) : T(0));
  if (points > 3) cloud.xyz[3 * (points / 2) + 1] = std::numeric_limits<T>::quiet_NaN();
  return cloud;
}

// `from`: number of the forest's first point.
void expect_as_one_tree(const PointForest& forest, const PointTree& tree, std::uint64_t from, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, 3);
  const auto same = [&](const ForestNeighbor& a, const Neighbor& b) {
    return a.number == from + static_cast<std::uint64_t>(b.index) && a.squared_distance == b.squared_distance;
  };
  ASSERT_EQ(forest.size(), tree.size());
  std::vector<ForestNeighbor> found;
  std::vector<Neighbor> expected;
  for (int i = 0; i < 60; ++i) {
    const Eigen::Vector3d place(normal(random), normal(random), std::round(normal(random)));
    const double distance = 0.25 * (i % 5);
    for (const std::size_t k : {std::size_t{0}, std::size_t{1}, std::size_t{7}, std::size_t{100}}) {
      const double limit = i % 3 == 0 ? distance : std::numeric_limits<double>::infinity();
      forest.nearest(place, k, found, limit);
      tree.nearest(place, k, expected, limit);
      ASSERT_TRUE(std::equal(found.begin(), found.end(), expected.begin(), expected.end(), same)) << k;
    }
    const auto one = forest.nearest(place, distance);
    const auto other = tree.nearest(place, distance);
    ASSERT_EQ(one.has_value(), other.has_value());
    ASSERT_TRUE(!one || same(*one, *other));
    forest.near(place, distance, found);
    tree.near(place, distance, expected);
    std::sort(found.begin(), found.end());
    std::sort(expected.begin(), expected.end());
    ASSERT_TRUE(std::equal(found.begin(), found.end(), expected.begin(), expected.end(), same));
    ASSERT_EQ(forest.any_inside(Sphere(place, distance)), tree.any_inside(Sphere(place, distance)));
  }
}

template <typename T>
void expect_grows(const std::vector<std::size_t>& sizes, std::size_t most_trees) {
  PointForest forest;
  Cloud<T> all;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const Cloud<T> more = batch<T>(sizes[i], static_cast<unsigned>(i));
    forest.insert(more.view());
    all.xyz.insert(all.xyz.end(), more.xyz.begin(), more.xyz.end());
    ASSERT_EQ(forest.inserted(), all.size());
    ASSERT_LE(forest.trees(), most_trees);
    if (i % 5 == 4 || i < 4) {
      ASSERT_NO_FATAL_FAILURE(expect_as_one_tree(forest, PointTree(all.view()), 0, static_cast<unsigned>(i)));
    }
  }
}

TEST(PointForest, OfEqualBatchesAnswersAsOneTreeAndHasFew) {
  expect_grows<float>(std::vector<std::size_t>(33, 100), 6);
  expect_grows<double>(std::vector<std::size_t>(17, 33), 5);
}

TEST(PointForest, OfBatchesOfAnySizeAnswersAsOneTreeAndHasFew) {
  expect_grows<float>({1, 1000, 2, 5, 0, 700, 3000, 1, 1, 1, 40, 40, 5000, 0, 9}, 13);
  std::vector<std::size_t> sizes;
  for (std::size_t i = 0; i < 200; ++i)
    sizes.push_back(1 + i * i % 17);
  expect_grows<float>(sizes, 11);
}

TEST(PointForest, OfKeptTreesAnswersForTheBatchesThatStay) {
  PointForest forest(ForestTrees::kept);
  std::vector<Cloud<float>> batches;
  std::uint64_t first = 0;
  for (unsigned i = 0; i < 12; ++i) {
    batches.push_back(batch<float>(i == 5 ? 0 : 150 + 10 * i, i));
    forest.insert(batches.back().view());
    if (i >= 4) {
      forest.drop_oldest();
      first += batches[i - 4].size();
    }
    ASSERT_EQ(forest.trees(), std::min<std::size_t>(i + 1, 4));
    Cloud<float> all;
    for (std::size_t k = i < 4 ? 0 : i - 3; k <= i; ++k)
      all.xyz.insert(all.xyz.end(), batches[k].xyz.begin(), batches[k].xyz.end());
    ASSERT_NO_FATAL_FAILURE(expect_as_one_tree(forest, PointTree(all.view()), first, i));
  }
  EXPECT_THROW(PointForest().drop_oldest(), std::logic_error);
}

TEST(PointForest, NumbersPointsAsTheyComeWhateverTheirViewsCallThem) {
  const auto cloud = batch<float>(400, 3);
  const std::vector<std::int32_t> indices = {399, 0, 17, 17, 250};
  PointForest forest;
  PointView some = cloud.view();
  some.indices = indices.data();
  some.count = indices.size();
  forest.insert(some);
  forest.insert(cloud.view().slice(100, 300));
  Cloud<float> all;
  for (const std::int32_t i : indices)
    all.xyz.insert(all.xyz.end(), cloud.xyz.begin() + 3 * i, cloud.xyz.begin() + 3 * i + 3);
  all.xyz.insert(all.xyz.end(), cloud.xyz.begin() + 300, cloud.xyz.end());
  expect_as_one_tree(forest, PointTree(all.view()), 0, 3);
}

TEST(PointForest, HoldsFloatsAndDoublesTogether) {
  const auto floats = batch<float>(300, 4);
  const auto doubles = test::gaussian<double>(300, 5, 3);
  PointForest forest;
  forest.insert(floats.view());
  forest.insert(doubles.view());
  forest.insert(floats.view());
  Cloud<double> all;
  for (const float x : floats.xyz)
    all.xyz.push_back(x);
  all.xyz.insert(all.xyz.end(), doubles.xyz.begin(), doubles.xyz.end());
  for (const float x : floats.xyz)
    all.xyz.push_back(x);
  expect_as_one_tree(forest, PointTree(all.view()), 0, 4);
}

TEST(PointForest, OfNoPointsHasNothingNear) {
  PointForest forest;
  forest.insert(PointView());
  EXPECT_FALSE(forest.nearest({0, 0, 0}));
  EXPECT_FALSE(forest.any_inside(Sphere({0, 0, 0}, 1)));
  EXPECT_EQ(forest.trees(), 0U);
  EXPECT_THROW(forest.nearest({0, 0, 0}, -1), std::invalid_argument);
}

}  // namespace
}  // namespace pcl_bv
