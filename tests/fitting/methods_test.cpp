// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/fitting/fit_into.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "clouds.h"
#include "fits.h"
#include "pcl_bv/numeric/directions.h"
#include "sources.h"

namespace pcl_bv::detail {
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
    AnyVolume volume = *method.fit(cloud.view());
    if (!method.shape.empty()) {
      EXPECT_EQ(shape_name(volume), method.shape) << method.name;
    }
  }
}

TEST(Methods, UprightAreThoseThatUpTurns) {
  const test::TestCloud<float> cloud = test::gaussian<float>(100, 1);
  for (const Method& method : methods()) {
    AnyVolume upright, lying;
    upright = *method.fit(cloud.view(), {SphereGrowth::deferred, Eigen::Vector3d::UnitZ()});
    lying = *method.fit(cloud.view(), {SphereGrowth::deferred, Eigen::Vector3d(1, 2, 3)});
    EXPECT_EQ(!(upright == lying), method.upright) << method.name;
  }
}

TEST(Methods, OfNothingHaveNoRank) {
  const float nan[] = {std::numeric_limits<float>::quiet_NaN(), 0, 0};
  for (const Method& method : methods()) {
    AnyVolume volume;
    const EstimationResult result = test::take(method.fit(PointView::of(nan, 12, 1)), volume);
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
    AnyVolume best = *find_method("best")->fit(cloud.view());
    for (const Method* method : best_candidates()) {
      AnyVolume other = *method->fit(cloud.view());
      EXPECT_LE(volume(best), volume(other)) << method->name << ", " << stretch;
    }
  }
}

TEST(Methods, TheSmallestOfAListSaysWhichItIs) {
  const test::TestCloud<float> cloud = test::gaussian<float>(500, 3);
  const FittedSmallest smallest =
      pcl_bv::fit_smallest(cloud.view(), {find_method("aabb"), find_method("hull"), find_method("sphere")});
  EXPECT_EQ(smallest.method, find_method("hull"));
  EXPECT_EQ(shape_name(*smallest), "hull");
  const FittedSmallest nothing = pcl_bv::fit_smallest(PointView(), {find_method("hull")});
  EXPECT_EQ(nothing.status, EstimationStatus::no_valid_points);
  EXPECT_EQ(nothing.method, nullptr);
  EXPECT_TRUE(empty(*nothing));
  EXPECT_THROW(pcl_bv::fit_smallest(cloud.view(), {}), std::invalid_argument);
}

TEST(Methods, FittedTogetherGiveTheirOwnBits) {
  const test::TestCloud<float> cloud = test::gaussian<float>(700, 4);
  const std::vector<Fitted<AnyVolume>> all = fit_methods(cloud.view(), methods_of_all());
  ASSERT_EQ(all.size(), methods_of_all().size());
  for (std::size_t m = 0; m < all.size(); ++m) {
    const Fitted<AnyVolume> alone = methods_of_all()[m]->fit(cloud.view());
    EXPECT_TRUE(*all[m] == *alone) << methods_of_all()[m]->name;
    EXPECT_EQ(all[m].used, alone.used);
    EXPECT_EQ(all[m].rank, alone.rank);
  }
}

TEST(Methods, OnTheHullAreThoseThatASharedHullSparesAPass) {
  const test::TestCloud<float> cloud = test::gaussian<float>(1000, 12);
  const test::CopyingSource<float> source(cloud);
  const PointView points = source.view();
  Supports hull, no_hull;
  const FitExecution with = share_supports(points, {find_method("hull"), find_method("capsule")}, {}, hull);
  const FitExecution without =
      share_supports(points, {find_method("dop14"), find_method("dop18")}, {}, no_hull);
  for (const Method& method : methods()) {
    const auto passes = [&](const FitExecution& shared) {
      const std::size_t before = source.loads;
      AnyVolume volume;
      fit_method(method, points, {}, volume, shared);
      return source.loads - before;
    };
    const bool on_hull =
        std::set<std::string_view>{"obb-min", "cylinder", "capsule", "ellipsoid", "hull", "best"}.contains(
            method.name);
    EXPECT_EQ(passes(with) < passes(without), on_hull) << method.name;
  }
}

// The least that one chunk of sharing can get wrong is one direction of one set.
TEST(Methods, WhatIsSharedChangesNoBit) {
  std::vector<test::TestCloud<float>> clouds;
  for (const std::size_t points : {0, 1, 20, 3000, 40'000})
    clouds.push_back(test::gaussian<float>(points, 11));
  // Two ends of a diagonal are farther apart than those of any axis.
  clouds.push_back({"star", {1, 0, 0, -1, 0, 0,  0,    1,    0,    0,     -1,    0,
                             0, 0, 1, 0,  0, -1, 0.9F, 0.9F, 0.9F, -0.9F, -0.9F, -0.6F}});
  for (test::TestCloud<float>& cloud : clouds) {
    if (cloud.size() > 10) cloud.xyz[30] = std::numeric_limits<float>::quiet_NaN();
    const PointView view = cloud.view();
    for (const Method& method : methods()) {
      AnyVolume alone;
      const EstimationResult expected = test::take(method.fit(view), alone);
      for (const char* other : {"aabb", "dop14", "dop18", "dop26", "obb-pca", "obb-dito14", "capsule"}) {
        Supports supports;
        const FitExecution shared = share_supports(view, {&method, find_method(other)}, {}, supports);
        AnyVolume together;
        const EstimationResult result = fit_method(method, view, {}, together, shared);
        SCOPED_TRACE(std::string(method.name) + " with " + other + ", " + cloud.name);
        EXPECT_TRUE(together == alone);
        test::expect_same_result(result, expected);
      }
    }
  }
}

TEST(Methods, SupportsAndHullsAreSharedOnlyWhereTwoWantThem) {
  const test::TestCloud<float> cloud = test::gaussian<float>(100, 12);
  Supports supports;
  const auto shares = [&](std::vector<const Method*> among) {
    return share_supports(cloud.view(), among, {}, supports).supports == &supports;
  };
  const auto named = find_method;
  EXPECT_FALSE(shares({}));
  EXPECT_FALSE(shares({named("dop26")}));
  EXPECT_FALSE(shares({named("dop26"), named("obb-pca")}));
  EXPECT_FALSE(shares({named("aabb"), named("sphere-ritter")}));  // six directions are cheap
  EXPECT_TRUE(shares({named("aabb"), named("obb-pca")}));
  EXPECT_EQ(supports.set, DirectionSet::dop6);
  EXPECT_EQ(supports.detail, SupportDetail::bounds);
  EXPECT_TRUE(shares({named("aabb"), named("dop14")}));
  EXPECT_EQ(supports.set, DirectionSet::dop14);
  EXPECT_TRUE(shares({named("dop14"), named("dop18")}));
  EXPECT_EQ(supports.set, DirectionSet::dop26);
  EXPECT_TRUE(shares({named("sphere-exact"), named("capsule")}));
  EXPECT_EQ(supports.hull, nullptr);
  EXPECT_TRUE(shares({named("obb-min"), named("capsule")}));
  EXPECT_NE(supports.hull, nullptr);
}

TEST(Methods, AabbReadsNoPointIfItsBoxIsShared) {
  const test::TestCloud<float> cloud = test::gaussian<float>(1000, 13);
  const test::CopyingSource<float> source(cloud);
  const PointView points = source.view();
  const std::vector<const Method*> both{find_method("aabb"), find_method("obb-pca")};
  Supports supports;
  const FitExecution shared = share_supports(points, both, {}, supports);
  const std::size_t before = source.loads;
  AnyVolume volume;
  fit_method(*both[0], points, {}, volume, shared);
  EXPECT_EQ(source.loads, before);
}

TEST(Methods, ASharedBoxReplacesNoKnownSupports) {
  const test::TestCloud<float> cloud = test::gaussian<float>(1000, 13);
  const PointView points = cloud.view();
  const std::vector<const Method*> both{find_method("aabb"), find_method("obb-pca")};
  Supports supports;
  const Supports known = find_supports(points, DirectionSet::dop26, SupportDetail::points);
  EXPECT_EQ(share_supports(points, both, FitExecution({}, &known), supports).supports, &known);
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

EstimationResult gives_up(const PointView& points, const MethodOptions&, AnyVolume& volume,
                          const FitExecution&) {
  volume.emplace<Hull>();
  return {EstimationStatus::failed, 3, points.count, 0, "gave up"};
}

TEST(Methods, TheSmallestLeavesOutThoseThatFail) {
  const test::TestCloud<float> cloud = test::gaussian<float>(500, 3);
  const MethodFit implementation{gives_up, {}, false};
  Method failing{"failing", {}, "hull"};
  failing.implementation = &implementation;
  const Method* const box = find_method("aabb");
  for (const std::vector<const Method*>& among :
       {std::vector<const Method*>{&failing, box}, {box, &failing}}) {
    const FittedSmallest smallest = pcl_bv::fit_smallest(cloud.view(), among);
    EXPECT_EQ(smallest.status, EstimationStatus::ok);
    EXPECT_EQ(smallest.method, box);
    EXPECT_EQ(shape_name(*smallest), "aabb");
  }
  const FittedSmallest none = pcl_bv::fit_smallest(cloud.view(), {&failing, &failing});
  EXPECT_EQ(none.status, EstimationStatus::failed);
  EXPECT_EQ(none.reason, "gave up");
  EXPECT_EQ(none.method, nullptr);
  EXPECT_TRUE(empty(*none));
}

// Tilted, in any order: a plane through the origin, a line, and a plane with one point just above or at what
// is flat.
TEST(Methods, AllSayTheSameRankHoweverPointsAreTiltedAndOrdered) {
  std::vector<std::pair<int, std::vector<double>>> clouds{{2, {}}, {1, {}}};
  for (int i = 0; i < 400; ++i) {
    const double x = 3.0 * (i % 20), y = 3.0 * (i / 20);
    clouds[0].second.insert(clouds[0].second.end(), {x, y, -(x + 2 * y) / 3});
    clouds[1].second.insert(clouds[1].second.end(), {x, -2 * x, 5 * x});
  }
  for (const double z : {0x1p-36, 0x1.00001p-36})
    clouds.push_back({z == 0x1p-36 ? 2 : 3, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, z}});
  for (auto& [rank, xyz] : clouds) {
    for (const bool reversed : {false, true}) {
      if (reversed) std::reverse(xyz.begin(), xyz.end());  // of z, y, x
      const PointView points = PointView::of(xyz.data(), 24, xyz.size() / 3);
      for (const Method& method : methods()) {
        AnyVolume volume;
        const EstimationResult result = test::take(method.fit(points), volume);
        EXPECT_EQ(result.rank, rank) << method.name << ", " << points.count << " points";
        EXPECT_EQ(result.status == EstimationStatus::ok, rank == 3) << method.name;
      }
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail
