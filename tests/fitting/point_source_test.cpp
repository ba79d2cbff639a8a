// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Points that come part by part give what points in memory give.

#include "fits.h"
#include "pcl_bv/points/point_source.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "executions.h"
#include "numbers.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/fitting/fit_into.h"
#include "pcl_bv/fitting/methods.h"
#include "sources.h"

namespace pcl_bv::detail {
namespace {

using test::CopyingSource;

// Two chunks and a piece of a third.
constexpr std::size_t kCount = 2 * kChunkPoints + 777;

template <typename T>
test::TestCloud<T> ball_surface() {
  test::TestCloud<T> cloud = test::gaussian<T>(kCount, 5);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    T* p = &cloud.xyz[3 * i];
    const T length = std::hypot(p[0], p[1], p[2]);
    for (int axis = 0; axis < 3; ++axis)
      p[axis] /= length;
  }
  cloud.name = "surface of a ball";
  return cloud;
}

template <typename T>
std::vector<test::TestCloud<T>> clouds() {
  std::vector<test::TestCloud<T>> all{test::gaussian<T>(kCount, 1), test::gaussian<T>(kCount, 2),
                                      ball_surface<T>()};
  for (std::size_t i = 0; i < all[1].xyz.size(); i += 100)
    all[1].xyz[i] = i % 3 == 0 ? std::numeric_limits<T>::quiet_NaN() : std::numeric_limits<T>::infinity();
  all[1].name = "with holes";
  return all;
}

// The hull of a ball's surface takes half a minute.
bool too_slow(const Method& method, const std::string& cloud) {
  return cloud == "surface of a ball" && method.implementation->directions == DirectionSet::dop26 &&
         method.shape != "sphere" && method.shape != "kdop" && !method.upright;
}

template <typename T>
void expect_same_fits() {
  for (const test::TestCloud<T>& cloud : clouds<T>()) {
    const CopyingSource<T> source(cloud);
    for (const Method& method : methods()) {
      if (too_slow(method, cloud.name) || method.name == "obb-min") continue;
      for (const SphereGrowth growth :
           {SphereGrowth::deferred, SphereGrowth::sequential, SphereGrowth::stationary}) {
        if (growth != SphereGrowth::deferred && method.shape != "sphere") continue;
        MethodOptions options;
        options.growth = growth;
        AnyVolume held;
        const EstimationResult expected = test::take(method.fit(cloud.view(), options), held);
        for (const Execution& execution : {Execution{}, Execution{OpenMP{3}}}) {
          AnyVolume passing;
          const EstimationResult result = test::take(method.fit(source.view(), options, execution), passing);
          SCOPED_TRACE(cloud.name + ", " + std::string(method.name));
          EXPECT_TRUE(passing == held);
          test::expect_same_result(result, expected);
        }
      }
    }
  }
}

TEST(PointSource, EveryMethodGivesTheBitsOfPointsInMemory) {
  expect_same_fits<float>();
}

TEST(PointSource, EveryMethodGivesTheBitsOfDoublesInMemory) {
  expect_same_fits<double>();
}

// Few points take ways of their own: all of them, not only the extremal ones, are asked for at once.
template <typename T>
void expect_same_fits_of_few() {
  for (const std::size_t n : {0, 1, 2, 5, 14, 28, 29, 98, 99, 300, 1000}) {
    test::TestCloud<T> cloud = test::gaussian<T>(n + 10, n);
    cloud.xyz[3 * 7 + 1] = std::numeric_limits<T>::quiet_NaN();
    const CopyingSource<T> source(cloud);
    for (const std::size_t begin : {0, 3}) {
      const PointView passing_points = source.view().slice(begin, n), points = cloud.view().slice(begin, n);
      for (const Method& method : methods()) {
        SCOPED_TRACE(cloud.name + ", from " + std::to_string(begin) + ", " + std::string(method.name));
        AnyVolume held, passing;
        const EstimationResult expected = test::take(method.fit(points), held);
        const EstimationResult result = test::take(method.fit(passing_points), passing);
        EXPECT_EQ(test::bits(passing), test::bits(held));
        test::expect_same_result(result, expected);
      }
    }
  }
}

TEST(PointSource, EveryMethodGivesTheBitsOfAFewPointsInMemory) {
  expect_same_fits_of_few<float>();
}

TEST(PointSource, EveryMethodGivesTheBitsOfAFewDoublesInMemory) {
  expect_same_fits_of_few<double>();
}

TEST(PointSource, TheMinimalBoxIsThatOfPointsInMemory) {
  const test::TestCloud<float> cloud = test::gaussian<float>(kCount, 1);
  const CopyingSource<float> source(cloud);
  AnyVolume held, passing;
  held = *find_method("obb-min")->fit(cloud.view());
  passing = *find_method("obb-min")->fit(source.view());
  EXPECT_TRUE(passing == held);
}

TEST(PointSource, NoExecutionChangesABit) {
  const test::TestCloud<float> cloud = clouds<float>()[1];
  const CopyingSource<float> source(cloud);
  for (const char* name : {"dop26", "sphere-exact", "sphere-epos26", "obb-dito14", "obb-pca"}) {
    AnyVolume expected = *find_method(name)->fit(cloud.view());
    for (const test::NamedExecution& execution : test::every_execution()) {
      AnyVolume volume = *find_method(name)->fit(source.view(), {}, execution.execution);
      EXPECT_TRUE(volume == expected) << name << ", " << execution.name;
    }
  }
}

TEST(PointSource, VerifySeesEveryPoint) {
  test::TestCloud<float> cloud = test::gaussian<float>(kCount, 3);
  const CopyingSource<float> source(cloud);
  AnyVolume box = *find_method("aabb")->fit(cloud.view());
  EXPECT_EQ(verify(box, source.view()).outside, 0U);
  EXPECT_EQ(verify(box, source.view()).checked, kCount);
  for (const std::size_t i : {std::size_t{0}, kChunkPoints, kCount - 1}) {
    const float kept = std::exchange(cloud.xyz[3 * i], 100.0f);
    EXPECT_EQ(verify(box, source.view()).outside, 1U) << i;
    cloud.xyz[3 * i] = kept;
  }
}

TEST(PointSource, ExtremePointsHaveTheirNumbersInTheSource) {
  test::TestCloud<float> cloud = test::gaussian<float>(kCount, 4);
  cloud.xyz[3 * (kCount - 5)] = 50;
  const CopyingSource<float> source(cloud);
  const Supports supports = find_supports(source.view(), DirectionSet::dop6, SupportDetail::points, {});
  EXPECT_EQ(supports.along[0].high_point.index, kCount - 5);
}

TEST(PointSource, WhatASourceThrowsReachesTheCaller) {
  const test::TestCloud<float> cloud = test::gaussian<float>(kCount, 6);
  CopyingSource<float> source(cloud);
  source.fail_at = kCount - 1;
  for (const Method& method : methods()) {
    AnyVolume volume;
    EXPECT_THROW(test::take(method.fit(source.view(), {}, {OpenMP{2}}), volume), std::runtime_error)
        << method.name;
  }
  EXPECT_THROW(verify(AnyVolume(), source.view()), std::runtime_error);
}

TEST(PointSource, ABoxTakesOnePassAndASphereTwo) {
  const test::TestCloud<float> cloud = test::gaussian<float>(kCount, 7);
  const CopyingSource<float> source(cloud);
  const std::size_t chunks = chunk_count(kCount);
  AnyVolume volume;
  // And the first chunk once more: some of its points tell the rank.
  test::take(find_method("aabb")->fit(source.view()), volume);
  EXPECT_EQ(source.loads.exchange(0), chunks + 1);
  volume = *find_method("dop26")->fit(source.view());
  EXPECT_EQ(source.loads.exchange(0), chunks + 1);
  volume = *find_method("sphere-epos26")->fit(source.view());
  EXPECT_LE(source.loads.exchange(0), chunks + 1 + (kCount + kBlockPoints - 1) / kBlockPoints);
}

TEST(PointSource, ABoxOfPointsFlatAcrossAnAxisTakesOnePassToo) {
  for (const std::size_t axis : {0U, 1U, 2U}) {
    test::TestCloud<float> cloud = test::gaussian<float>(kCount, 7);
    for (std::size_t i = 0; i < kCount; ++i)
      cloud.xyz[3 * i + axis] = 5;
    const CopyingSource<float> source(cloud);
    AnyVolume volume;
    EXPECT_EQ(test::take(find_method("aabb")->fit(source.view()), volume).rank, 2);
    EXPECT_EQ(source.loads, chunk_count(kCount) + 1) << axis;
  }
}

TEST(PointSource, APartOfAViewIsThatPart) {
  const test::TestCloud<double> cloud = test::gaussian<double>(kCount, 8);
  const CopyingSource<double> source(cloud);
  const PointView part = source.view().slice(1000, 40'000);
  const LoadedPoints loaded(part, 500, 10);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(loaded.view().index(i), 1500 + i);
    EXPECT_EQ(load_point(loaded.view(), i), load_point(cloud.view(), 1500 + i));
  }
}

TEST(PointSource, TwoLoadsOfOneThreadDoNotShareABuffer) {
  const test::TestCloud<float> cloud = test::gaussian<float>(kCount, 9);
  const CopyingSource<float> source(cloud);
  for (int round = 0; round < 3; ++round) {
    const LoadedPoints first(source.view(), 0, 100), second(source.view(), 100, 100),
        third(source.view(), 200, 100);
    EXPECT_EQ(load_point(first.view(), 0), load_point(cloud.view(), 0));
    EXPECT_EQ(load_point(second.view(), 99), load_point(cloud.view(), 199));
    EXPECT_EQ(load_point(third.view(), 99), load_point(cloud.view(), 299));
  }
}

}  // namespace
}  // namespace pcl_bv::detail
