// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What belongs to other points, or to points that have changed, gives no volume without a word.

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "fits.h"
#include "pcl_bv/fitting/fit_into.h"
#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/fitting/supports.h"
#include "sources.h"

namespace pcl_bv::detail {
namespace {

using test::CopyingSource;
using test::TestCloud;

TEST(Misuse, NoFitTakesTheExtremesOfOtherPoints) {
  const TestCloud<float> cloud = test::gaussian<float>(1000, 1), other = test::gaussian<float>(1000, 2, 9);
  const std::vector<std::int32_t> indices(1000, 3);
  const CopyingSource<float> source(cloud);
  PointView listed = cloud.view();
  listed.indices = indices.data();
  for (const Supports& supports :
       {find_supports(cloud.view(), DirectionSet::dop26, SupportDetail::points, {}),
        find_supports(cloud.view(), DirectionSet::dop6, SupportDetail::bounds, {})}) {
    const FitExecution shared({}, &supports);
    AnyVolume volume;
    for (const Method& method : methods())
      EXPECT_NO_THROW(fit_method(method, cloud.view(), {}, volume, shared)) << method.name;
    for (const PointView& points :
         {other.view(), cloud.view().slice(0, 999), cloud.view().slice(1, 999), listed, source.view()}) {
      for (const Method& method : methods()) {
        EXPECT_THROW(fit_method(method, points, {}, volume, shared), std::invalid_argument) << method.name;
      }
      EXPECT_THROW(find_supports(points, {{1, 2, 3}}, shared), std::invalid_argument);
    }
  }
}

TEST(Misuse, AViewHasASourceOrIndices) {
  const TestCloud<float> cloud = test::gaussian<float>(100, 5);
  const CopyingSource<float> source(cloud);
  const std::vector<std::int32_t> indices = {1, 2, 3};
  PointView view = source.view();
  view.indices = indices.data();
  view.count = indices.size();
  EXPECT_THROW(LoadedPoints(view, 0, 1), std::invalid_argument);
  for (const Method& method : methods()) {
    AnyVolume volume;
    EXPECT_THROW(test::take(method.fit(view), volume), std::invalid_argument) << method.name;
  }
}

TEST(Misuse, NoMorePointsAreLoadedThanAViewHasAndAChunkHolds) {
  const TestCloud<float> cloud = test::gaussian<float>(2 * kChunkPoints, 6);
  const CopyingSource<float> source(cloud);
  for (const PointView& points : {cloud.view(), source.view()}) {
    EXPECT_NO_THROW(LoadedPoints(points, kChunkPoints, kChunkPoints));
    EXPECT_NO_THROW(LoadedPoints(points, 2 * kChunkPoints, 0));
    EXPECT_THROW(LoadedPoints(points, 2 * kChunkPoints, 1), std::out_of_range);
    EXPECT_THROW(LoadedPoints(points, 2 * kChunkPoints + 1, 0), std::out_of_range);
    EXPECT_THROW(LoadedPoints(points, 1, std::numeric_limits<std::size_t>::max()), std::out_of_range);
  }
  EXPECT_THROW(LoadedPoints(source.view(), 0, kChunkPoints + 1), std::invalid_argument);
}

// Gives a view that somebody else has made wrong.
struct WrongSource : PointSource {
  PointView load(std::size_t, std::size_t, std::vector<std::byte>&) const override { return wrong; }
  PointView wrong;
};

TEST(Misuse, ASourceMustGiveThePointsThatItIsAskedFor) {
  const TestCloud<float> cloud = test::gaussian<float>(10, 7);
  WrongSource source;
  const auto load = [&](std::size_t begin) {
    LoadedPoints(view_of(source, 20, ScalarType::float32), begin, 10);
  };
  source.wrong = cloud.view();
  EXPECT_NO_THROW(load(0));
  EXPECT_THROW(load(1), std::invalid_argument);
  source.wrong.count = 9;
  EXPECT_THROW(load(0), std::invalid_argument);
  source.wrong = cloud.view();
  source.wrong.scalar = ScalarType::float64;
  EXPECT_THROW(load(0), std::invalid_argument);
  source.wrong = view_of(source, 10, ScalarType::float32);
  EXPECT_THROW(load(0), std::invalid_argument);
}

template <typename T>
TestCloud<T> scaled(TestCloud<T> cloud, double scale, double offset, const std::string& name) {
  for (T& c : cloud.xyz)
    c = static_cast<T>(static_cast<double>(c) * scale + offset);
  cloud.name = name;
  return cloud;
}

// What may be in a place where a cloud was.
template <typename T>
std::vector<TestCloud<T>> successors(const TestCloud<T>& cloud) {
  std::vector<TestCloud<T>> all = {scaled(cloud, 0.01, 0, "tiny"), scaled(cloud, 1, 5000, "far away"),
                                   scaled(cloud, sizeof(T) == 4 ? 1e37 : 1e99, 0, "huge"),
                                   scaled(cloud, 0, 0, "one point")};
  all.push_back(scaled(cloud, 1, 0, "nothing valid"));
  all.back().xyz.assign(cloud.xyz.size(), std::numeric_limits<T>::quiet_NaN());
  all.push_back(scaled(cloud, 1, 0, "one left"));
  std::fill(all.back().xyz.begin() + 3, all.back().xyz.end(), std::numeric_limits<T>::infinity());
  return all;
}

// A fit of points that change after each of its first loads: it throws or gives a volume.
template <typename T>
void expect_no_crash(const TestCloud<T>& cloud, const TestCloud<T>& later, const Method& method) {
  for (std::size_t loads = 1; loads <= 6; ++loads) {
    CopyingSource<T> source(cloud);
    source.later = &later;
    source.loads_before = loads;
    AnyVolume volume;
    try {
      volume = *method.fit(source.view());
    } catch (const std::invalid_argument&) {
      continue;
    }
    // Who reads no more often has seen one cloud; for others volumes are as finite as the points.
    EXPECT_TRUE(empty(volume) || pcl_bv::volume(volume) >= 0)
        << method.name << " of " << cloud.name << ", then " << later.name << ", " << loads;
  }
}

template <typename T>
void expect_no_crash_of_any() {
  for (const double scale : {1.0, 1e-41}) {
    for (const std::size_t n : {3, 20, 60, 300}) {
      const TestCloud<T> cloud = test::gaussian<T>(n, n, scale);
      for (const TestCloud<T>& later : successors(cloud)) {
        for (const Method& method : methods())
          expect_no_crash(cloud, later, method);
      }
    }
  }
}

TEST(Misuse, NoFitCrashesWhereFloatsChangeBetweenItsPasses) {
  expect_no_crash_of_any<float>();
}

TEST(Misuse, NoFitCrashesWhereDoublesChangeBetweenItsPasses) {
  expect_no_crash_of_any<double>();
}

TEST(Misuse, FitsOfHullsRefusePointsThatChangeAfterTheirExtremes) {
  const TestCloud<float> cloud = test::gaussian<float>(3000, 8);
  for (const TestCloud<float>& later : successors(cloud)) {
    for (const char* name :
         {"obb-min", "obb-yaw", "obb-lshape", "prism", "cylinder", "capsule", "ellipsoid", "hull", "best"}) {
      CopyingSource<float> source(cloud);
      source.later = &later;
      // obb-min looks for a first valid point before its supports.
      source.loads_before = std::string(name) == "obb-min" ? 2 : 1;
      AnyVolume volume;
      EXPECT_THROW(test::take(find_method(name)->fit(source.view()), volume), std::invalid_argument)
          << name << ", then " << later.name;
    }
  }
}

TEST(Misuse, BoxesRefuseAnotherNumberOfValidPointsInALaterPass) {
  const TestCloud<float> cloud = test::gaussian<float>(3000, 9);
  for (const TestCloud<float>& later : successors(cloud)) {
    if (later.name != "nothing valid" && later.name != "one left") continue;
    for (const char* name : {"obb-pca", "obb-dito14"}) {
      CopyingSource<float> source(cloud);
      source.later = &later;
      source.loads_before = std::string(name) == "obb-pca" ? 2 : 1;
      AnyVolume volume;
      EXPECT_THROW(test::take(find_method(name)->fit(source.view()), volume), std::invalid_argument)
          << name << ", then " << later.name;
    }
  }
}

TEST(Misuse, ObbPcaRefusesAnotherNumberOfValidPointsThanItsSharedBoxHas) {
  const TestCloud<float> cloud = test::gaussian<float>(1500, 9);
  TestCloud<float> later = cloud;  // of the same box: only points within it are gone
  for (std::size_t i = 1; i < 1500; ++i) {
    const Eigen::Vector3f p(later.xyz[3 * i], later.xyz[3 * i + 1], later.xyz[3 * i + 2]);
    if (p.norm() < 1) later.xyz[3 * i] = std::numeric_limits<float>::quiet_NaN();
  }
  CopyingSource<float> source(cloud);
  Supports supports;
  const std::vector<const Method*> both{find_method("aabb"), find_method("obb-pca")};
  const FitExecution shared = share_supports(source.view(), both, {}, supports);
  source.later = &later;
  source.loads_before = source.loads;
  AnyVolume volume;
  EXPECT_THROW(fit_method(*both[1], source.view(), {}, volume, shared), std::invalid_argument);
}

}  // namespace
}  // namespace pcl_bv::detail
