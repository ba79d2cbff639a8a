// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Claims of fit_prism() beyond those of every method (fit_test.cpp, partial_test.cpp).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>

#include "clouds.h"
#include "encloses.h"
#include "executions.h"
#include "fits.h"
#include "numbers.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/fitting/partial.h"

namespace pcl_bv::detail {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using test::numbers;
using test::TestCloud;

constexpr int kRandomClouds = test::kFewCases ? 300 : 10'000;

std::vector<Vector3d> up_axes() {
  return {Vector3d::UnitZ(), -Vector3d::UnitY(), Vector3d::UnitX(), {0.1, -0.2, 1}, {1, 2, 3}, {1e-9, 0, 1}};
}

// The corners of the convex hull by trying all pairs of points: p -> q is an edge if no point is to its right
// and none on its line is beyond q.
std::vector<Vector2d> slow_hull(const std::vector<Vector2d>& points) {
  using test::Rational;
  std::vector<Vector2d> corners;
  for (const Vector2d& p : points) {
    const bool corner = std::any_of(points.begin(), points.end(), [&](const Vector2d& q) {
      return q != p && std::all_of(points.begin(), points.end(), [&](const Vector2d& r) {
               const Rational x = Rational(q.x()) - Rational(p.x()), y = Rational(q.y()) - Rational(p.y());
               const Rational rx = Rational(r.x()) - Rational(p.x()), ry = Rational(r.y()) - Rational(p.y());
               const Rational left = x * ry, right = y * rx;
               return left > right || (left == right && x * rx + y * ry >= 0);
             });
    });
    if (corner && std::find(corners.begin(), corners.end(), p) == corners.end()) corners.push_back(p);
  }
  return corners;
}

TEST(FitPrism, UpZHasTheExactHullOfThePointsSeenFromAboveAndTheirHeights) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    TestCloud<float> cloud =
        test::gaussian<float>(3 + seed % 30, seed, seed % 3 == 0 ? 1 : 20, seed % 2 == 0 ? 0 : 1e5);
    std::vector<Vector2d> flat;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (seed % 5 == 0) cloud.xyz[3 * i] = std::round(cloud.xyz[3 * i]);
      flat.emplace_back(cloud.xyz[3 * i], cloud.xyz[3 * i + 1]);
      low = std::min<double>(low, cloud.xyz[3 * i + 2]);
      high = std::max<double>(high, cloud.xyz[3 * i + 2]);
    }
    const Prism prism = *fit_prism(cloud.view());
    std::vector<Vector2d> expected = slow_hull(flat), found = prism.outline();
    const auto before = [](const Vector2d& a, const Vector2d& b) {
      return std::make_pair(a.x(), a.y()) < std::make_pair(b.x(), b.y());
    };
    EXPECT_EQ(found.front(), *std::min_element(found.begin(), found.end(), before));
    std::sort(expected.begin(), expected.end(), before);
    std::sort(found.begin(), found.end(), before);
    EXPECT_EQ(found, expected) << cloud.name;
    EXPECT_EQ(prism.low(), low);
    EXPECT_EQ(prism.high(), high);
    EXPECT_EQ(prism.axes(), Eigen::Matrix3d::Identity());
  }
}

template <typename T>
void expect_encloses_along_every_axis() {
  for (const TestCloud<T>& cloud : test::nasty_clouds<T>()) {
    for (const Vector3d& up : up_axes()) {
      SCOPED_TRACE(cloud.name);
      const Fitted<Prism> fitted = fit_prism(cloud.view(), up);
      EXPECT_EQ(fitted->empty(), fitted.used == 0);
      test::expect_encloses(*fitted, cloud.view());
      EXPECT_EQ(verify(*fitted, cloud.view()).outside, 0U);
      EXPECT_EQ(fitted.status, fit_aabb(cloud.view()).status);
      EXPECT_EQ(fitted.rank, fit_aabb(cloud.view()).rank);
    }
  }
}

TEST(FitPrism, EnclosesEveryFloatPointAlongEveryAxisInExactArithmetic) {
  expect_encloses_along_every_axis<float>();
}
TEST(FitPrism, EnclosesEveryDoublePointAlongEveryAxisInExactArithmetic) {
  expect_encloses_along_every_axis<double>();
}

// A random cloud. Some are flat, on a line, at one position, at one height, or full of zeros of both signs.
template <typename T>
TestCloud<T> random_cloud(int kind, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  const int range = sizeof(T) == sizeof(float) ? 30 : 40;
  const double denormal = sizeof(T) == sizeof(float) ? 0x1p-145 : 0x1p-1070;
  const double scale = kind == 9 ? denormal : std::exp2(std::round(range * uniform(random)));
  const double offset = kind % 3 != 0 ? 0 : kind % 2 == 0 ? 5e6 : 1e9;
  TestCloud<T> cloud = test::gaussian<T>(kind == 1 ? 1 : 1 + random() % 40, random(), scale, offset);
  for (std::size_t k = 0; k < cloud.size(); ++k) {
    T* const p = &cloud.xyz[3 * k];
    if (kind == 2 || kind == 3) p[1] = 2 * p[0];  // a wall
    if (kind == 3 || kind == 4) p[2] = p[0];      // a line or a plane
    if (kind == 5 || kind == 6) p[2] = cloud.xyz[2];
    if (kind == 7) std::copy_n(cloud.xyz.data(), 3, p);
    for (int i = 0; kind == 8 && i < 3; ++i)
      p[i] = random() % 2 == 0 ? T(0) : random() % 2 == 0 ? -T(0) : std::round(p[i] / T(scale));
  }
  return cloud;
}

TEST(FitPrism, LeavesNoPointOfManyRandomCloudsOutside) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < kRandomClouds; ++i) {
    const std::vector<Vector3d> axes = up_axes();
    const Vector3d up =
        i % 3 == 0 ? axes[random() % axes.size()] : Vector3d(uniform(random), uniform(random), 1);
    const auto expect_none_outside = [&](const auto& cloud) {
      const Prism prism = *fit_prism(cloud.view(), up);
      ASSERT_EQ(verify(prism, cloud.view()).outside, 0U) << "seed 7, cloud " << i;
    };
    if (i % 2 == 0) {
      expect_none_outside(random_cloud<double>(i / 2 % 12, random));
    } else {
      expect_none_outside(random_cloud<float>(i / 2 % 12, random));
    }
  }
}

TEST(FitPrism, IsTightToAFewUnitsInTheLastPlaceAlongAnyAxis) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const double offset = seed % 2 == 0 ? 0 : 5e6;
    const TestCloud<double> cloud = test::gaussian<double>(500, seed, 1, offset);
    for (const Vector3d& up : up_axes()) {
      const Prism prism = *fit_prism(cloud.view(), up);
      for (int k = 0; k < 60; ++k) {
        const Vector3d n = std::cos(0.1 * k) * prism.axes().col(0) + std::sin(0.1 * k) * prism.axes().col(1);
        double farthest = -std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < cloud.size(); ++i)
          farthest = std::max(farthest, n.dot(Vector3d::Map(&cloud.xyz[3 * i])));
        EXPECT_NEAR(n.dot(prism.support(n)), farthest, 32 * 0x1p-53 * (10 + 2 * offset)) << cloud.name;
      }
    }
  }
}

TEST(FitPrism, DoesNotDependOnTheOrderOfThePointsOrTheExecution) {
  std::mt19937_64 random(5);
  for (const std::size_t n : {50, 3000, 70'000}) {
    const TestCloud<float> cloud = test::gaussian<float>(n, n);
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::shuffle(order.begin(), order.end(), random);
    TestCloud<float> shuffled = cloud;
    for (std::size_t i = 0; i < n; ++i)
      std::copy_n(&cloud.xyz[3 * order[i]], 3, &shuffled.xyz[3 * i]);
    for (const Vector3d& up : up_axes()) {
      const std::vector<double> expected = numbers(*fit_prism(cloud.view(), up, {Serial{}, Isa::scalar}));
      EXPECT_EQ(numbers(*fit_prism(shuffled.view(), up)), expected) << n << ", " << up.transpose();
      for (const auto& [name, execution] : test::every_execution())
        EXPECT_EQ(numbers(*fit_prism(cloud.view(), up, execution)), expected) << name << ", " << n;
    }
  }
}

TEST(FitPrism, OfPartsHasTheBitsOfTheWholeAlongAnyAxis) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const TestCloud<float> cloud = test::gaussian<float>(20'000, seed);
    Partial merged(cloud.view().slice(0, 7000));
    merged.merge(Partial(cloud.view().slice(7000, 13'000), 7000));
    for (const Vector3d& up : up_axes()) {
      MethodOptions options;
      options.up = up;
      EXPECT_EQ(numbers(*merged.fit(*find_method("prism"), options)),
                numbers(AnyVolume(*fit_prism(cloud.view(), up))))
          << "seed " << seed << ", up " << up.transpose();
    }
  }
}

TEST(FitPrism, OfAFlatCloudIsFlatAlongACoordinateAxis) {
  const double wall[] = {0, 0, 0, 1, 2, 5, 2, 4, 1, 0.5, 1, 7};
  const Fitted<Prism> prism = fit_prism(PointView::of(wall, 3 * sizeof(double), 4));
  EXPECT_EQ(prism->outline(), (std::vector<Vector2d>{{0, 0}, {2, 4}}));
  EXPECT_EQ(prism.status, EstimationStatus::degenerate);
  EXPECT_EQ(prism.rank, 2);
  EXPECT_EQ(prism->volume(), 0);
  EXPECT_EQ(fit_prism(PointView::of(wall, 3 * sizeof(double), 1))->outline().size(), 1U);
  const Fitted<Prism> tilted = fit_prism(PointView::of(wall, 3 * sizeof(double), 4), Vector3d(1, 1, 3));
  EXPECT_EQ(tilted.rank, 2);
}

TEST(FitPrism, OneFitPerClusterIsThatOfItsPoints) {
  const TestCloud<float> cloud = test::gaussian<float>(300, 4);
  const IndexLists clusters{{0, 5, 7, 9, 10, 11, 12, 200, 299}, {0, 4, 4, 9}};
  const std::vector<Fitted<Prism>> fits = fit_prism(cloud.view(), clusters, Vector3d(1, 1, 1));
  ASSERT_EQ(fits.size(), 3U);
  EXPECT_TRUE(fits[1]->empty());
  EXPECT_EQ(*fits[2], *fit_prism(subsets(cloud.view(), clusters)[2], Vector3d(1, 1, 1)));
}

TEST(FitPrism, RefusesAnUpWhoseLargestComponentIsNotFrom1em30To1e30) {
  const TestCloud<float> cloud = test::gaussian<float>(30, 4);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Vector3d& up :
       {Vector3d(0, 0, 0), Vector3d(nan, 0, 1), Vector3d(0.9e-30, 0, 0), Vector3d(0, 0, -1.1e30)})
    EXPECT_THROW(fit_prism(cloud.view(), up), std::invalid_argument);
  for (const Vector3d& up : {Vector3d(1e-30, 0, 0), Vector3d(1, 0, -1e30)})
    EXPECT_NO_THROW(fit_prism(cloud.view(), up));
}

}  // namespace
}  // namespace pcl_bv::detail
