// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Trees of nothing, questions from beyond the range, and hosts with an arithmetic of their own.

#include <gtest/gtest.h>

#include "flush_to_zero.h"
#include "pcl_bv/trees/volume_tree.h"
#include "scattered_volumes.h"

namespace pcl_bv::detail {
namespace {

using namespace testing;
using Volumes = std::vector<AnyVolume>;
using Indices = std::vector<std::int32_t>;

TEST(VolumeTree, OfNoVolumesOrEmptyOnesFindsNothing) {
  for (const VolumeTree& tree :
       {VolumeTree(), VolumeTree(Volumes{}), VolumeTree(Volumes{Aabb(), Sphere(), Hull()})}) {
    Indices found = {1};
    std::vector<VolumeHit> hits(1);
    tree.all_containing({0, 0, 0}, found);
    tree.all_hit({0, 0, 0}, {1, 0, 0}, hits);
    EXPECT_TRUE(found.empty() && hits.empty());
    found = {1};
    tree.all_with_box_overlapping(Aabb({-1, -1, -1}, {1, 1, 1}), found);
    EXPECT_TRUE(found.empty());
    found = {1};
    tree.all_overlapping(Sphere({0, 0, 0}, 1), found);
    EXPECT_TRUE(found.empty());
    EXPECT_FALSE(tree.any_containing({0, 0, 0}));
    EXPECT_FALSE(tree.first_hit({0, 0, 0}, {1, 0, 0}));
    EXPECT_FALSE(tree.nearest({0, 0, 0}));
  }
}

TEST(VolumeTree, IsTheSameOnAHostThatFlushesToZero) {
  Random random(26);
  const Volumes volumes = scattered_volumes(random, {"1e-41", 0, 1e-41}, 100, 20);
  const VolumeTree tree(volumes);
  for (const AnyVolume& volume : volumes) {
    const Vector3d p = center(volume), to = 0.5 * center(volumes[7]);
    Indices expected, found;
    tree.all_containing(p, expected);
    const auto hit = tree.first_hit(p, to - p);
    const test::FlushToZero flushing;
    VolumeTree(volumes).all_containing(p, found);
    EXPECT_EQ(found, expected);
    EXPECT_EQ(tree.first_hit(p, to - p).has_value(), hit.has_value());
  }
}

TEST(VolumeTree, RefusesDistancesThatAreNone) {
  EXPECT_THROW(VolumeTree().nearest({0, 0, 0}, -1), std::invalid_argument);
  EXPECT_THROW(VolumeTree().nearest({0, 0, 0}, kNan), std::invalid_argument);
}

TEST(VolumeTree, IsFoundFromWhereSquaresOfItsUnitLeaveTheRange) {
  const VolumeTree tree({Sphere({0, 0, 0}, 1e-90), Sphere({1e-90, 0, 0}, 1e-90)});
  for (const double away : {1e-20, 1.0, 1e70, 1e100}) {
    const Vector3d place(away, 0, 0);
    ASSERT_TRUE(tree.nearest(place)) << away;
    EXPECT_EQ(tree.nearest(place)->distance, distance(tree.volumes()[1], place)) << away;
    EXPECT_TRUE(tree.first_hit(place, {-1, 0, 0})) << away;
    EXPECT_FALSE(tree.any_containing(place)) << away;
  }
}

TEST(VolumeTree, FindsTheNearestFromBeyondTheRangeOfItsBoxes) {
  const VolumeTree tree({Sphere(), Sphere({1, 2, 3}, 1)});
  EXPECT_EQ(tree.nearest({1e200, 0, 0})->index, 1);
}

// Their ends of a ray are known less well than a box is.
TEST(VolumeTree, HitsEllipsoidsThatAreMillionsOfTimesLongerThanWide) {
  Random random(27);
  for (int round = 0; round < 2000; ++round) {
    const Vector3d radii(1, std::pow(10, random.uniform(-12, 0)), std::pow(10, random.uniform(-12, 0)));
    const Ellipsoid ellipsoid(random.vector(1), random.isometry(0).linear(), radii);
    const VolumeTree tree({ellipsoid});
    // Along the surface, near its ends.
    const Vector3d tip = support(AnyVolume(ellipsoid), random.vector(1));
    const Vector3d to = random.vector(1), from = tip - to;
    const auto expected = intersect(ellipsoid, from, to);
    const auto found = tree.first_hit(from, to);
    ASSERT_EQ(found.has_value(), expected.has_value()) << round;
    if (expected) {
      EXPECT_EQ(found->interval.enter, expected->enter) << round;
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail
