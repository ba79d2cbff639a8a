// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What is inside volumes, and nearest to them, as if each point were asked.

#include <gtest/gtest.h>

#include "clouds.h"
#include "each_point.h"
#include "pcl_bv/volumes/pair_queries.h"

namespace pcl_bv::detail {
namespace {

using namespace testing;

template <typename T>
class PointTreeInside : public ::testing::Test {};
using ScalarTypes = ::testing::Types<float, double>;
TYPED_TEST_SUITE(PointTreeInside, ScalarTypes);

// Points on the surfaces of all volumes, a few units in the last place from them, and anywhere.
TYPED_TEST(PointTreeInside, ListsTheSamePointsAsContains) {
  Random random(3);
  for (const Scale& scale : scales()) {
    if (sizeof(TypeParam) == 4 && (scale.extent > 1e30 || scale.extent < 1e-30)) continue;
    const std::vector<AnyVolume> volumes = volumes_of_every_kind(random, scale);
    test::TestCloud<TypeParam> cloud;
    for (const AnyVolume& volume : volumes) {
      for (const Vector3d& p : points_about(random, volume, 1e-3 * scale.extent, 40)) {
        for (const double c : p)
          cloud.xyz.push_back(static_cast<TypeParam>(c));
      }
    }
    const EachPoint points(cloud.view());
    for (const Isa isa : usable_isas()) {
      const PointTree tree(cloud.view(), {Serial{}, isa});
      std::size_t some = 0;
      for (const AnyVolume& volume : volumes) {
        const std::vector<std::int32_t> inside = points.inside(volume);
        std::vector<std::int32_t> found = {7};
        tree.all_inside(volume, found);
        ASSERT_EQ(found, inside) << shape_name(volume) << ", " << scale.name << ", " << isa_name(isa);
        EXPECT_EQ(tree.count_inside(volume), inside.size());
        EXPECT_EQ(tree.any_inside(volume), !inside.empty());
        some += !inside.empty() && inside.size() < points.size();
      }
      // Steps of float are half a metre at UTM.
      if (sizeof(TypeParam) == 8 || scale.extent > 1e-3) {
        EXPECT_GT(some, volumes.size() / 2) << scale.name;
      }
    }
  }
}

TEST(PointTree, HasThePointNearestToAVolumeAsIfEachWereAsked) {
  Random random(20);
  for (const Scale& scale : scales()) {
    if (scale.extent < 1e-100 || scale.extent > 1e38) continue;
    test::TestCloud<double> cloud;
    for (int i = 0; i < 500; ++i) {
      const Vector3d p = random.point({"", scale.offset, 6 * scale.extent});
      cloud.xyz.insert(cloud.xyz.end(), p.begin(), p.end());
    }
    const EachPoint points(cloud.view());
    const PointTree tree(cloud.view());
    for (const AnyVolume& volume : volumes_of_every_kind(random, scale)) {
      const ConvexBody body(volume);
      PointDistance expected{-1, kInfinity};
      for (std::size_t i = 0; i < points.size(); ++i) {
        const double d = distance(body, points.places()[i]);
        if (d < expected.distance) expected = {static_cast<std::int32_t>(i), d};
      }
      const auto found = tree.nearest_to(volume);
      ASSERT_TRUE(found.has_value());
      EXPECT_EQ(found->index, expected.index) << shape_name(volume) << ", " << scale.name;
      EXPECT_EQ(found->distance, expected.distance);
      EXPECT_EQ(tree.nearest_to(volume, expected.distance)->index, expected.index);
      EXPECT_FALSE(expected.distance > 0 && tree.nearest_to(volume, 0.999 * expected.distance));
    }
    EXPECT_FALSE(tree.nearest_to(Sphere()));
  }
}

// Boxes of a tree that is larger than a crossing volume hold or spare whole groups.
TEST(PointTree, ListsTheSamePointsAsContainsInsideLargeVolumes) {
  const auto cloud = test::gaussian<float>(20'000, 4);
  const EachPoint points(cloud.view());
  const PointTree tree(cloud.view());
  Random random(5);
  for (int round = 0; round < 10; ++round) {
    for (const AnyVolume& volume : volumes_of_every_kind(random, {"unit", 0, 2})) {
      std::vector<std::int32_t> found;
      tree.all_inside(volume, found);
      ASSERT_EQ(found, points.inside(volume)) << shape_name(volume);
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail
