// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Boxes alone may say yes only where a point must be near: asked with limits just short of the nearest one.

#include <gtest/gtest.h>

#include "each_point.h"
#include "point_tree_state.h"
#include "vectors.h"

namespace pcl_bv::detail {
namespace {

using namespace testing;

void expect_decided_at_the_nearest(const PointView& cloud, const std::vector<Vector3d>& places) {
  const EachPoint points(cloud);
  for (const Isa isa : usable_isas()) {
    const PointTree tree(cloud, {Serial{}, isa});
    ASSERT_GT(packed_tree(tree).boxes.levels, 2U) << "boxes are looked at below those it starts with";
    for (const Vector3d& place : places) {
      const double square = points.near(place, kInfinity).front().squared_distance;
      const Coordinates center = coordinates(place);
      EXPECT_TRUE(any_in_ball(tree.isa(), packed_tree(tree), center, square)) << isa_name(isa);
      EXPECT_FALSE(any_in_ball(tree.isa(), packed_tree(tree), center, square * (1 - 0x1p-40)))
          << isa_name(isa);
    }
  }
}

template <typename T>
class AnyInBallOf : public ::testing::Test {};
using ScalarTypes = ::testing::Types<float, double>;
TYPED_TEST_SUITE(AnyInBallOf, ScalarTypes);

// Packets of 16 equal points, whose boxes are as near as they: far away rounding is all that parts them.
TYPED_TEST(AnyInBallOf, IsDecidedByPointsWhereBoxesAreAsNearAsThese) {
  Random random(1);
  test::TestCloud<TypeParam> cloud;
  for (int site = 0; site < 300; ++site) {
    const Vector3d p = random.vector(1);
    for (int i = 0; i < 16; ++i) {
      for (int axis = 0; axis < 3; ++axis)
        cloud.xyz.push_back(static_cast<TypeParam>(p[axis]));
    }
  }
  std::vector<Vector3d> places;
  for (int i = 0; i < 30; ++i)
    places.push_back(std::pow(10, i % 5) * random.vector(1));
  expect_decided_at_the_nearest(cloud.view(), places);
}

// Packets that are lines along an axis, seen from between two of their points.
TYPED_TEST(AnyInBallOf, IsDecidedByPointsInsideLongBoxes) {
  for (int axis = 0; axis < 3; ++axis) {
    Random random(2);
    test::TestCloud<TypeParam> cloud;
    std::vector<Vector3d> places;
    for (int site = 0; site < 300; ++site) {
      const Vector3d first = random.vector(100);
      for (int i = 0; i < 16; ++i) {
        const Vector3d p = first + 0.0625 * i * Vector3d::Unit(axis);
        for (int k = 0; k < 3; ++k)
          cloud.xyz.push_back(static_cast<TypeParam>(p[k]));
      }
      if (site % 10 == 0) places.emplace_back(first + 0.46875 * Vector3d::Unit(axis));
    }
    expect_decided_at_the_nearest(cloud.view(), places);
  }
}

}  // namespace
}  // namespace pcl_bv::detail
