// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clouds of several levels of boxes, and margins at their limits.

#include "tree_overlap.h"

#include <gtest/gtest.h>

#include "any_volumes.h"
#include "clouds.h"
#include "pcl_bv/trees/collision.h"
#include "scattered_volumes.h"
#include "transformed_point.h"

namespace pcl_bv::detail {
namespace {

using namespace testing;

// Of one point, how far it is from a place is exact where a square and its root are.
TEST(AnyWithin, IsDecidedAtTheDistanceAndTheImagesError) {
  Random random(1);
  for (const double size : {1e-100, 1e-3, 1.0, 1e6, 1e90}) {
    for (int round = 0; round < 200; ++round) {
      const Vector3d place = random.vector(size);
      const PointTree tree(PointView::of(place.data(), 24, 1));
      const auto distance = test::least_root_above(squared_distance(exact(place), exact(Vector3d(0, 0, 0))),
                                                   place.stableNorm());
      const double error = (round % 2) * 0.5 * distance;
      EXPECT_TRUE(any_within(tree, {{0, 0, 0}, error}, distance - error));
      EXPECT_TRUE(any_within(tree, {{0, 0, 0}, error}, 1.5 * distance));
      EXPECT_FALSE(any_within(tree, {{0, 0, 0}, error}, distance * (1 - 0x1.8p-49) - error));
    }
  }
}

// Any packet of the cloud may have the point that is nearest.
TEST(CloudsWithin, OfManyPointsAreDecidedByTheNearest) {
  const auto others = test::gaussian<float>(9000, 2);
  const PointTree moving(others.view());
  Random random(3);
  const Eigen::Isometry3d pose = random.isometry(2);
  for (std::size_t i = 0; i < others.size(); i += 37) {
    const Coordinates p = load_point(others.view(), i);
    const Vector3d place = pose * Vector3d(p.x, p.y, p.z) + random.vector(0.03);
    const PointTree tree(PointView::of(place.data(), 24, 1));
    double nearest = kInfinity;
    for (std::size_t k = 0; k < others.size(); ++k) {
      const Coordinates q = load_point(others.view(), k);
      nearest = std::min(nearest, (pose * Vector3d(q.x, q.y, q.z) - place).norm());
    }
    ASSERT_TRUE(within(tree, moving, pose, nearest + 1e-13)) << i;
    ASSERT_FALSE(within(tree, moving, pose, nearest - 1e-13)) << i;
    ASSERT_TRUE(within(moving, tree, pose.inverse(), nearest + 1e-13)) << i;
  }
}

TEST(Within, TakesMarginsUpToTheGreatestCoordinate) {
  const Vector3d place(1, 2, 3);
  const PointTree tree(PointView::of(place.data(), 24, 1));
  const MovingVolumes ball({Sphere(place, 1)});
  const Eigen::Isometry3d still = Eigen::Isometry3d::Identity();
  for (const double margin : {0.0, 1e100}) {
    EXPECT_TRUE(within(tree, tree, still, margin));
    EXPECT_TRUE(within(tree, ball, still, margin));
    EXPECT_TRUE(within(ball, ball, still, margin));
  }
  for (const double margin : {std::nextafter(1e100, kInfinity), std::nextafter(0.0, -1.0), kInfinity}) {
    EXPECT_THROW(within(tree, tree, still, margin), std::invalid_argument);
    EXPECT_THROW(within(tree, ball, still, margin), std::invalid_argument);
    EXPECT_THROW(within(ball, ball, still, margin), std::invalid_argument);
  }
}

// The second holds half of space, the third all, others nothing.
TEST(VolumesWithin, OfNoBoxAreAskedAndEmptyOnesAreNot) {
  const MovingVolumes volumes(odd_volumes(1));
  const Vector3d normal(0.1, 0.2, 0.3);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (const Vector3d& place : {Vector3d(0, 0, 0), Vector3d(-5, -5, -5), Vector3d(5, 5, 5)}) {
    pose.translation() = 0.5 * place;
    const PointTree tree(PointView::of(place.data(), 24, 1));
    for (const double margin : {0.0, 1.0}) {
      std::vector<std::int32_t> touched, expected = {2};
      if (normal.dot(0.5 * place) - 0.5 <= margin * normal.norm()) expected = {1, 2};
      list_within(tree, volumes, pose, margin, touched);
      EXPECT_EQ(touched, expected) << place.transpose();
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail
