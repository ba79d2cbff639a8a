// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Prisms whose outline is not convex, in masks and trees.
#include <gtest/gtest.h>

#include <random>

#include "executions.h"
#include "outlines.h"
#include "pcl_bv/trees/point_tree.h"
#include "pcl_bv/trees/region_mask.h"
#include "pcl_bv/trees/volume_tree.h"

namespace pcl_bv::detail {
namespace {

using Eigen::Vector3d;
using testing::Polygon;

template <typename T>
std::vector<T> points_about(const Polygon& outline, std::mt19937_64& random, std::size_t count) {
  std::uniform_real_distribution<double> uniform(-0.2, 1.2);
  Eigen::Vector2d low = outline[0], high = low;
  for (const Eigen::Vector2d& corner : outline) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  std::vector<T> xyz;
  for (std::size_t i = 0; i < count; ++i) {
    const bool at_corner = i % 10 == 0;
    const Eigen::Vector2d& corner = outline[i / 10 % outline.size()];
    for (int k = 0; k < 2; ++k)
      xyz.push_back(static_cast<T>(at_corner ? corner[k] : low[k] + uniform(random) * (high[k] - low[k])));
    xyz.push_back(static_cast<T>(uniform(random)));
  }
  return xyz;
}

template <typename T>
void expect_contains_in_masks_and_trees() {
  std::mt19937_64 random(1);
  for (const Polygon& outline : testing::polygons(1, 30)) {
    const Prism prism(Eigen::Matrix3d::Identity(), outline, 0, 1);
    const std::vector<T> xyz = points_about<T>(outline, random, 2000);
    const PointView points = PointView::of(xyz.data(), 3 * sizeof(T), xyz.size() / 3);
    std::vector<std::uint8_t> expected, found;
    std::vector<std::int32_t> indices, expected_indices;
    for (std::size_t i = 0; i < points.count; ++i) {
      const Coordinates p = load_point(points, i);
      expected.push_back(prism.contains({p.x, p.y, p.z}) ? 1 : 0);
      if (expected.back() != 0) expected_indices.push_back(static_cast<std::int32_t>(i));
    }
    ASSERT_FALSE(expected_indices.empty());
    for (const auto& [name, execution] : test::every_execution()) {
      RegionMask({{prism, 0}}).mark(points, found, execution);
      ASSERT_EQ(found, expected) << name;
    }
    const PointTree tree(points);
    tree.all_inside(prism, indices);
    EXPECT_EQ(indices, expected_indices);
    EXPECT_EQ(tree.count_inside(prism), expected_indices.size());
    EXPECT_TRUE(tree.any_inside(prism));
  }
}

TEST(ConcavePrism, MarksAndFindsTheFloatPointsThatItContains) {
  expect_contains_in_masks_and_trees<float>();
}
TEST(ConcavePrism, MarksAndFindsTheDoublePointsThatItContains) {
  expect_contains_in_masks_and_trees<double>();
}

TEST(ConcavePrism, InAVolumeTreeIsHitOnlyWhereItIs) {
  const Prism prism(Eigen::Matrix3d::Identity(), testing::l_shape(), 0, 2);
  const VolumeTree tree({Prism(prism), Sphere({20, 0, 0}, 1)});
  EXPECT_FALSE(tree.first_hit({2, 2, 5}, {0, 0, -1})) << "down into the bay";
  const auto hit = tree.first_hit({0.5, 2, 5}, {0, 0, -1});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->index, 0);
}

TEST(ConcavePrism, PaddedMarksEveryPointWithinThePadding) {
  const Prism prism(Eigen::Matrix3d::Identity(), testing::l_shape(), 0, 2);
  const RegionMask mask({{prism, 0.25}});
  EXPECT_TRUE(mask.contains({1.2, 3, 1}));
  EXPECT_TRUE(mask.contains({1.15, 1.15, 2.2}));
  EXPECT_FALSE(mask.contains({4, 4, 1}));
}

}  // namespace
}  // namespace pcl_bv::detail
