// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Claims of the oriented boxes beyond those that fit_test.cpp makes of every method (enclosure in exact
// arithmetic, the same bits everywhere): degenerate clouds, tightness, names of axes, what is refused.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "allocations.h"
#include "executions.h"
#include "fits.h"
#include "numbers.h"
#include "obbs.h"
#include "pcl_bv/fitting/fit.h"
#include "sources.h"

namespace pcl_bv::detail {
namespace {

using namespace test;
using Eigen::Matrix3d;
using Eigen::Vector3d;

TEST(Obb, OfNothingIsEmptyAndOfOnePointThatPoint) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const TestCloud<float> nothing{"", {}}, bad{"", {nan, 0, 0}}, one{"", {5e6F, -3, 0.1F}},
      many{"", {0.1F, 0.2F, 7, 0.1F, 0.2F, 7, nan, 0, 0, 0.1F, 0.2F, 7}};
  for (const ObbMethod method : kMethods) {
    Obb box(Aabb({0, 0, 0}, {1, 1, 1}));
    EXPECT_EQ(take(fit_obb(nothing.view(), method), box).status, EstimationStatus::no_valid_points);
    EXPECT_TRUE(box.empty());
    EXPECT_EQ(take(fit_obb(bad.view(), method), box).dropped, 1U);
    EXPECT_TRUE(box.empty());
    EXPECT_EQ(take(fit_obb(one.view(), method), box).rank, 0);
    EXPECT_LE((box.center() - Vector3d(5e6F, -3, double(0.1F))).norm(), 1e-9);
    EXPECT_LE(box.half_extents().norm(), 1e-9);
    const EstimationResult result = take(fit_obb(many.view(), method), box);
    EXPECT_EQ(result.rank, 0);
    EXPECT_EQ(result.used, 3U);
    EXPECT_LE(box.half_extents().norm(), 1e-14);
  }
}

TEST(Obb, OfALineIsThinAlongItAndOfAPlaneFlatInIt) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 20; ++i) {
    const Matrix3d turn = random_turn(random);
    TestCloud<double> line{"line", {}}, plane{"plane", {}};
    for (int n = 0; n < 300; ++n) {
      for (const double c : Vector3d(turn * Vector3d(4 * uniform(random), 0, 0) + Vector3d(7, 8, 9)))
        line.xyz.push_back(c);
      Vector3d p(4 * uniform(random), 2 * uniform(random), 0);
      if (n < 4) p = {n & 1 ? 4.0 : -4.0, n & 2 ? 2.0 : -2.0, 0};
      for (const double c : Vector3d(turn * p + Vector3d(7, 8, 9)))
        plane.xyz.push_back(c);
    }
    for (const ObbMethod method : kAnyAxes) {
      EXPECT_LE(fit(line, method).half_extents()[1], 1e-13) << static_cast<int>(method);
      EXPECT_LE(fit(plane, method).half_extents()[2], 1e-13) << static_cast<int>(method);
    }
    const Obb tile = fit(plane, ObbMethod::minimal);
    EXPECT_TRUE(tile.half_extents().head<2>().isApprox(Eigen::Vector2d(4, 2), 1e-12))
        << tile.half_extents().transpose();
  }
}

TEST(Obb, IsTightAlongEachAxisAtUtmCoordinatesToo) {
  for (const double offset : {0.0, 5e6}) {
    const TestCloud<double> cloud = test::gaussian<double>(3000, 9, 20, offset);
    for (const ObbMethod method : kMethods) {
      const Obb box = fit(cloud, method);
      for (int i = 0; i < 3; ++i) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (std::size_t n = 0; n < cloud.size(); ++n) {
          const Vector3d q =
              Vector3d(cloud.xyz[3 * n], cloud.xyz[3 * n + 1], cloud.xyz[3 * n + 2]) - box.center();
          low = std::min(low, box.axis(i).dot(q));
          high = std::max(high, box.axis(i).dot(q));
        }
        const double ulp = 4e-16 * (offset + 100);
        EXPECT_NEAR(high, box.half_extents()[i], 6 * ulp);
        EXPECT_NEAR(low, -box.half_extents()[i], 6 * ulp);
      }
    }
  }
}

TEST(Obb, ACubeDoesNotFlipUnderNoise) {
  std::mt19937_64 random(10);
  std::uniform_real_distribution<double> noise(-1e-14, 1e-14);
  Obb first;
  for (int i = 0; i < 30; ++i) {
    TestCloud<double> cube = box_cloud<double>({1, 1, 1}, Matrix3d::Identity(), {0, 0, 0}, 500, 11);
    for (double& c : cube.xyz)
      c += noise(random);
    const Obb box = fit(cube, ObbMethod::minimal);
    if (i == 0) first = box;
    EXPECT_TRUE(box.axes().isApprox(first.axes(), 1e-9)) << i;
  }
}

TEST(Obb, OfAnyAxesIsCanonical) {
  for (const ObbMethod method : kAnyAxes) {
    const Obb box = fit(test::gaussian<float>(500, 12), method);
    EXPECT_EQ(box, box.canonical());
  }
}

TEST(Obb, LargeCloudsHaveTheSameBitsOnAnyNumberOfThreads) {
  const TestCloud<float> cloud =
      test::gaussian<float>(std::min<std::size_t>(300'000, test::kThreadedPoints), 13);
  for (const ObbMethod method : kMethods) {
    const Obb expected = fit(cloud, method, {Serial{}, Isa::automatic});
    EXPECT_EQ(verify(expected, cloud.view()).outside, 0U);
    for (const auto& [name, execution] : test::every_execution()) {
      SCOPED_TRACE(name);
      EXPECT_EQ(test::bits(fit(cloud, method, execution)), test::bits(expected));
    }
  }
}

TEST(Obb, OfAnIndexListIsThatOfItsPoints) {
  const TestCloud<float> cloud = test::gaussian<float>(3000, 14);
  std::vector<std::int32_t> indices(1200);
  std::iota(indices.begin(), indices.end(), 900);
  PointView view = cloud.view(), slice = view.slice(900, 1200);
  view.indices = indices.data();
  view.count = indices.size();
  for (const ObbMethod method : kMethods) {
    Obb listed, sliced;
    listed = *fit_obb(view, method);
    sliced = *fit_obb(slice, method);
    EXPECT_EQ(listed, sliced);
  }
}

template <typename T>
std::vector<TestCloud<T>> small_clouds() {
  std::vector<TestCloud<T>> clouds = nasty_clouds<T>();
  for (std::size_t n = 0; n <= 35; ++n) {
    clouds.push_back(gaussian<T>(n, n));
    TestCloud<T> flat = gaussian<T>(n, n), bad = flat;
    flat.name += " flat";
    bad.name += " bad";
    for (std::size_t i = 0; i < n; ++i) {
      flat.xyz[3 * i + n % 3] = 2;
      if (i % 5 == n % 5) bad.xyz[3 * i + n % 3] = std::numeric_limits<T>::quiet_NaN();
    }
    TestCloud<T> twice = gaussian<T>(2 * n, n);
    std::copy_n(twice.xyz.begin(), 3 * n, twice.xyz.begin() + static_cast<std::ptrdiff_t>(3 * n));
    twice.name += " twice";
    clouds.insert(clouds.end(),
                  {flat, bad, twice, {"NaN", std::vector<T>(3 * n, std::numeric_limits<T>::quiet_NaN())}});
  }
  for (const std::size_t n : {1023, 1024, 1025, 2047, 2048, 2049})
    clouds.push_back(gaussian<T>(n, n));
  return clouds;
}

// Points of a source are copied for each step. Points in memory are copied once if they are a block.
template <typename T>
void expect_pca_of_the_source() {
  for (const TestCloud<T>& cloud : small_clouds<T>()) {
    const CopyingSource<T> source(cloud);
    Obb expected, found, scalar;
    const EstimationResult a = take(fit_obb(source.view(), ObbMethod::pca), expected);
    const EstimationResult b = take(fit_obb(cloud.view(), ObbMethod::pca), found);
    take(fit_obb(cloud.view(), ObbMethod::pca, {Serial{}, Isa::scalar}), scalar);
    SCOPED_TRACE(cloud.name);
    EXPECT_TRUE(found == expected && found == scalar);
    expect_same_result(b, a);
  }
}

TEST(Obb, OfPcaHasTheSameBitsFromASourceAndFromMemory) {
  expect_pca_of_the_source<float>();
  expect_pca_of_the_source<double>();
}

TEST(Obb, OfAClusterAllocatesNothingForDito14AndYaw) {
  const TestCloud<float> cloud = test::gaussian<float>(300, 15);
  Obb box;
  for (const ObbMethod method : {ObbMethod::pca, ObbMethod::dito14, ObbMethod::yaw}) {
    box = *fit_obb(cloud.view(), method);  // what is made once is made now
    const std::size_t before = allocations();
    box = *fit_obb(cloud.view(), method);
    EXPECT_EQ(allocations(), before) << static_cast<int>(method);
  }
}

TEST(Obb, SupportsAlongAnUpThatIsACoordinateAxisAreThoseOfTheCloud) {
  TestCloud<double> cloud{"", {}};
  std::mt19937_64 random(17);
  for (int i = 0; i < 300; ++i) {
    for (const double size : {3.0, 5.0, 9.0})
      cloud.xyz.push_back(size * static_cast<double>(random() % 4097) / 4096);
  }
  const Aabb box = *fit_aabb(cloud.view());
  for (const ObbMethod method : kUpright) {
    for (int k = 0; k < 3; ++k) {
      const Obb upright = *fit_obb(cloud.view(), {method, Vector3d::Unit(k)});
      const Vector3d up = Vector3d::Unit(k);
      EXPECT_EQ(upright.support(up)[k], box.max()[k]) << static_cast<int>(method) << ", axis " << k;
      EXPECT_EQ(upright.support(-up)[k], box.min()[k]) << static_cast<int>(method) << ", axis " << k;
    }
  }
}

TEST(Obb, RefusesAnUpWhoseLargestComponentIsNotFrom1em30To1e30) {
  Obb box;
  const TestCloud<float> cloud = test::gaussian<float>(10, 16);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const ObbMethod method : kUpright) {
    for (const Vector3d& up :
         {Vector3d(0, 0, 0), Vector3d(0, nan, 1), Vector3d(0.9e-30, 0, 0), Vector3d(0, -1.1e30, 0)})
      EXPECT_THROW(take(fit_obb(cloud.view(), {method, up}), box), std::invalid_argument);
    for (const Vector3d& up : {Vector3d(1e-30, 0, 0), Vector3d(1, 0, -1e30)})
      EXPECT_NO_THROW(take(fit_obb(cloud.view(), {method, up}), box));
  }
  EXPECT_NO_THROW(take(fit_obb(cloud.view(), {ObbMethod::pca, {0, 0, 0}}), box)) << "it does not ask for it";
}

}  // namespace
}  // namespace pcl_bv::detail
