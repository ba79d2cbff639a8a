// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/fitting/methods.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <stdexcept>

#include "clouds.h"
#include "pcl_bv/numeric/directions.h"

namespace pcl_bv {
namespace {

TEST(Methods, AllIsEveryMethodInOrderButTheHullAndBest) {
  std::vector<std::string_view> names, expected;
  for (const Method* method : methods_of_all())
    names.push_back(method->name);
  for (const Method& method : methods()) {
    if (method.name != "hull" && method.name != "best") expected.push_back(method.name);
  }
  EXPECT_EQ(names, expected);
  EXPECT_EQ(names.size() + 2, methods().size());
}

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
    if (!method.shape.empty()) {
      EXPECT_EQ(shape_name(volume), method.shape) << method.name;
    }
  }
}

TEST(Methods, OfNothingHaveNoRank) {
  const float nan[] = {std::numeric_limits<float>::quiet_NaN(), 0, 0};
  for (const Method& method : methods()) {
    AnyVolume volume;
    const EstimationResult result = method.fit(PointView::of(nan, 12, 1), volume, {});
    EXPECT_EQ(result.status, EstimationStatus::no_valid_points) << method.name;
    EXPECT_EQ(result.rank, 0) << method.name;
    EXPECT_TRUE(empty(volume)) << method.name;
  }
}

TEST(Methods, BestIsTheSmallestOfItsCandidates) {
  for (const double stretch : {0.1, 1.0, 20.0}) {
    test::TestCloud<float> cloud = test::gaussian<float>(500, 3);
    for (std::size_t i = 0; i < cloud.size(); ++i)
      cloud.xyz[3 * i] *= static_cast<float>(stretch);
    AnyVolume best;
    find_method("best")->fit(cloud.view(), best, {});
    for (const Method* method : best_candidates()) {
      AnyVolume other;
      method->fit(cloud.view(), other, {});
      EXPECT_LE(volume(best), volume(other)) << method->name << ", " << stretch;
    }
  }
}

TEST(Methods, TheSmallestOfAListSaysWhichItIs) {
  const test::TestCloud<float> cloud = test::gaussian<float>(500, 3);
  const Method* winner = nullptr;
  AnyVolume volume;
  fit_smallest(cloud.view(), {find_method("aabb"), find_method("hull"), find_method("sphere")}, volume, {},
               {}, &winner);
  EXPECT_EQ(winner, find_method("hull"));
  EXPECT_EQ(shape_name(volume), "hull");
  EXPECT_EQ(fit_smallest(PointView(), {winner}, volume, {}, {}, &winner).status,
            EstimationStatus::no_valid_points);
  EXPECT_EQ(winner, nullptr);
  EXPECT_TRUE(empty(volume));
  EXPECT_THROW(fit_smallest(cloud.view(), {}, volume), std::invalid_argument);
}

// The least that one chunk of sharing can get wrong is one direction of one set.
TEST(Methods, SharedExtremesChangeNoBit) {
  for (const std::size_t points : {0UL, 1UL, 20UL, 3000UL, 40'000UL}) {
    test::TestCloud<float> cloud = test::gaussian<float>(points, 11);
    if (points > 10) cloud.xyz[30] = std::numeric_limits<float>::quiet_NaN();
    const PointView view = cloud.view();
    for (const Method& method : methods()) {
      AnyVolume alone;
      const EstimationResult expected = method.fit(view, alone, {});
      for (const char* other : {"aabb", "dop14", "dop18", "dop26", "obb-dito14"}) {
        Extremes extremes;
        const Execution shared = share_extremes(view, {&method, find_method(other)}, {}, extremes);
        AnyVolume together;
        const EstimationResult result = method.fit(view, together, shared);
        EXPECT_TRUE(together == alone) << method.name << " with " << other << ", " << points;
        EXPECT_EQ(result.rank, expected.rank) << method.name << " with " << other << ", " << points;
        EXPECT_EQ(result.used, expected.used);
        EXPECT_EQ(result.dropped, expected.dropped);
        EXPECT_EQ(result.status, expected.status);
      }
    }
  }
}

TEST(Methods, ExtremesAreSharedOnlyWhereTwoWantThem) {
  const test::TestCloud<float> cloud = test::gaussian<float>(100, 12);
  Extremes extremes;
  const auto shares = [&](std::vector<const Method*> among) {
    return share_extremes(cloud.view(), among, {}, extremes).extremes == &extremes;
  };
  const auto named = find_method;
  EXPECT_FALSE(shares({}));
  EXPECT_FALSE(shares({named("dop26")}));
  EXPECT_FALSE(shares({named("dop26"), named("obb-pca")}));
  EXPECT_FALSE(shares({named("aabb"), named("sphere-ritter")}));  // six directions are cheap
  EXPECT_TRUE(shares({named("aabb"), named("dop14")}));
  EXPECT_EQ(extremes.set, DirectionSet::dop14);
  EXPECT_TRUE(shares({named("dop14"), named("dop18")}));
  EXPECT_EQ(extremes.set, DirectionSet::dop26);
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
