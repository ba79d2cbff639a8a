// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/fitting/methods.h"

#include <gtest/gtest.h>

#include <set>

#include "clouds.h"
#include "pcl_bv/kernels/directions.h"

namespace pcl_bv {
namespace {

TEST(Methods, NamesAndAliasesAreUnique) {
  std::set<std::string_view> names;
  for (const Method& method : methods()) {
    EXPECT_TRUE(names.insert(method.name).second) << method.name;
    for (const std::string_view alias : method.aliases)
      EXPECT_TRUE(names.insert(alias).second) << alias;
  }
}

TEST(Methods, EachIsFoundByItsName) {
  for (const Method& method : methods())
    EXPECT_EQ(find_method(method.name), &method);
  EXPECT_EQ(find_method("no such method"), nullptr);
}

TEST(Methods, EachGivesTheShapeItSays) {
  const test::TestCloud<float> cloud = test::gaussian<float>(100, 1);
  for (const Method& method : methods()) {
    AnyVolume volume;
    method.fit(cloud.view(), volume, {});
    EXPECT_EQ(shape_name(volume), method.shape) << method.name;
  }
}

TEST(Methods, TheKernelsDirectionsAreTheVolumes) {
  for (const auto& [set, volume_set] :
       {std::pair{DirectionSet::dop6, KdopSet::dop6()}, std::pair{DirectionSet::dop14, KdopSet::dop14()},
        std::pair{DirectionSet::dop18, KdopSet::dop18()}, std::pair{DirectionSet::dop26, KdopSet::dop26()}}) {
    ASSERT_EQ(direction_count(set), volume_set->size());
    for (std::size_t k = 0; k < volume_set->size(); ++k) {
      const auto& d = kCubeDirections[cube_direction(set, k)];
      EXPECT_EQ(volume_set->direction(k), Eigen::Vector3d(d[0], d[1], d[2]));
    }
  }
}

}  // namespace
}  // namespace pcl_bv
