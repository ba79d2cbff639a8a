// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Claims of fit_prism() with a concave outline.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

#include "concave_clouds.h"
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
using test::body;
using test::cloud_of;
using test::expect_sound;
using test::hedge;
using test::numbers;
using test::TestCloud;

constexpr int kClouds = test::kFewCases ? 200 : 3000;
constexpr double kInfinite = std::numeric_limits<double>::infinity();

struct Case {
  std::vector<Vector3d> points;
  double length;
};

Case random_case(int i, std::mt19937_64& random) {
  std::uniform_real_distribution<double> exponent(-3, 2);
  Case made{body(i, random, 3 + random() % 150), std::exp2(exponent(random))};
  const double scale = i / 9 % 4 == 0 ? 0x1p-20 : 1;
  const Vector3d offset = i / 9 % 3 == 0 ? Vector3d(5e5, 4.5e6, 100) : Vector3d::Zero();
  for (Vector3d& p : made.points)
    p = scale * p + offset;
  made.length *= scale;
  return made;
}

TEST(ConcavePrism, EnclosesEveryPointOfManyCloudsInExactArithmetic) {
  std::mt19937_64 random(1);
  for (int i = 0; i < kClouds; ++i) {
    const Case made = random_case(i, random);
    const std::string what = "seed 1, cloud " + std::to_string(i);
    if (i % 2 == 0) {
      expect_sound(cloud_of<double>(made.points), Vector3d::UnitZ(), made.length, what);
    } else {
      expect_sound(cloud_of<float>(made.points), Vector3d::UnitZ(), made.length, what);
    }
  }
}

TEST(ConcavePrism, EnclosesEveryPointAlongAnyAxis) {
  std::mt19937_64 random(2);
  std::size_t concave = 0, count = 0;
  for (int i = 0; i < kClouds / 8; ++i) {
    const Case made = random_case(i, random);
    const TestCloud<double> cloud = cloud_of<double>(made.points);
    for (const Vector3d& up : {Vector3d(0.1, -0.2, 1), Vector3d(1e-9, 0, 1), Vector3d(0, -1, 0)}) {
      expect_sound(cloud, up, made.length, "seed 2, cloud " + std::to_string(i));
      if (i % 9 > 3 || up.y() == -1) continue;
      ++count;
      concave += (*fit_prism(cloud.view(), {up, made.length})).is_convex() ? 0 : 1;
    }
  }
  EXPECT_GT(concave, count / 2) << "rounding is no reason to give up a bay";
}

TEST(ConcavePrism, NastyCloudsAreEnclosed) {
  for (const TestCloud<float>& cloud : test::nasty_clouds<float>()) {
    for (const double length : {0.01, 10.0})
      expect_sound(cloud, Vector3d::UnitZ(), length, cloud.name);
  }
}

TEST(ConcavePrism, OfAHedgeAroundACornerHasHardlyMoreAreaThanTheHedge) {
  std::mt19937_64 random(3);
  const TestCloud<float> cloud = cloud_of<float>(hedge(random, 20'000));
  const double convex = fit_prism(cloud.view())->footprint_area();
  EXPECT_GT(convex, 170);  // 28 x 11 / 2 and the corners
  EXPECT_LT(fit_prism(cloud.view(), {Vector3d::UnitZ(), 2})->footprint_area(), 50);
  const double area = fit_prism(cloud.view(), {Vector3d::UnitZ(), 0.5})->footprint_area();
  EXPECT_GT(area, 35);
  EXPECT_LT(area, 39);  // the hedge has 38
}

TEST(ConcavePrism, AShorterLengthHasNoLargerArea) {
  std::mt19937_64 random(4);
  for (int kind = 0; kind < 9; ++kind) {
    const TestCloud<double> cloud = cloud_of<double>(body(kind, random, 2000));
    double before = kInfinite;
    for (const double length : {kInfinite, 8.0, 4.0, 2.0, 1.0, 0.5, 0.25}) {
      const double area = fit_prism(cloud.view(), {Vector3d::UnitZ(), length})->footprint_area();
      EXPECT_LE(area, before) << kind << ", " << length;
      before = area;
    }
  }
}

TEST(ConcavePrism, OfAnInfiniteOrALargeLengthHasTheBitsOfTheConvexOne) {
  std::mt19937_64 random(5);
  for (int kind = 0; kind < 9; ++kind) {
    const TestCloud<double> cloud = cloud_of<double>(body(kind, random, 500));
    for (const Vector3d& up : {Vector3d(0, 0, 1), Vector3d(0.1, -0.2, 1)}) {
      const std::vector<double> convex = numbers(*fit_prism(cloud.view(), up));
      EXPECT_EQ(numbers(*fit_prism(cloud.view(), {up, kInfinite})), convex);
      EXPECT_EQ(numbers(*fit_prism(cloud.view(), {up, 100})), convex);
    }
  }
}

TEST(ConcavePrism, HasCornersThatArePoints) {
  std::mt19937_64 random(6);
  const std::vector<Vector3d> points = hedge(random, 3000);
  const Prism prism = *fit_prism(cloud_of<double>(points).view(), {Vector3d::UnitZ(), 1});
  EXPECT_GT(prism.outline().size(), 20U);
  for (const Vector2d& corner : prism.outline()) {
    EXPECT_TRUE(
        std::any_of(points.begin(), points.end(), [&](const Vector3d& p) { return p.head<2>() == corner; }));
  }
}

TEST(ConcavePrism, DoesNotDependOnTheOrderOfThePointsOrTheExecution) {
  std::mt19937_64 random(7);
  for (int kind = 0; kind < 9; ++kind) {
    std::vector<Vector3d> points = body(kind, random, kind == 0 ? 70'000 : 2000);
    const TestCloud<float> cloud = cloud_of<float>(points);
    for (const Vector3d& up : {Vector3d(0, 0, 1), Vector3d(0.1, -0.2, 1)}) {
      const PrismOptions options{up, 0.7};
      const std::vector<double> expected =
          numbers(*fit_prism(cloud.view(), options, {Serial{}, Isa::scalar}));
      std::shuffle(points.begin(), points.end(), random);
      points.push_back(points[points.size() / 2]);  // a point twice
      EXPECT_EQ(numbers(*fit_prism(cloud_of<float>(points).view(), options)), expected) << kind;
      for (const auto& [name, execution] : test::every_execution())
        EXPECT_EQ(numbers(*fit_prism(cloud.view(), options, execution)), expected) << name << ", " << kind;
    }
  }
}

TEST(ConcavePrism, MovesWithItsPoints) {
  std::mt19937_64 random(8);
  for (int kind = 0; kind < 4; ++kind) {
    std::vector<Vector3d> points;
    for (const Vector3d& p : body(kind, random, 1000))  // 2^-20 m, so that the moved points are doubles
      points.push_back((p * 0x1p20).array().round() * 0x1p-20);
    std::vector<Vector3d> moved = points;
    const Vector3d shift(1024, -4096, 8);
    for (Vector3d& p : moved)
      p += shift;
    const Prism before = *fit_prism(cloud_of<double>(points).view(), {Vector3d::UnitZ(), 1});
    const Prism after = *fit_prism(cloud_of<double>(moved).view(), {Vector3d::UnitZ(), 1});
    ASSERT_FALSE(before.is_convex());
    EXPECT_NEAR(before.footprint_area(), after.footprint_area(), 0.05 * before.footprint_area()) << kind;
  }
}

TEST(ConcavePrism, NeedsAllPointsNotPartialResults) {
  const Method& prism = *find_method("prism");
  MethodOptions options;
  EXPECT_TRUE(Partial::can_fit(prism, options));
  options.concave_length = 1;
  EXPECT_FALSE(Partial::can_fit(prism, options));
  EXPECT_TRUE(needs_all_points(prism, options));
  EXPECT_TRUE(Partial::can_fit(*find_method("hull"), options));
  const TestCloud<float> cloud = test::gaussian<float>(30, 4);
  EXPECT_THROW(Partial(cloud.view()).fit(prism, options), std::invalid_argument);
}

TEST(ConcavePrism, FitsWithOtherMethodsHaveTheBitsOfTheFitAlone) {
  std::mt19937_64 random(9);
  const TestCloud<float> cloud = cloud_of<float>(hedge(random, 3000));
  MethodOptions options;
  options.concave_length = 1;
  const Method* const prism = find_method("prism");
  const auto together =
      fit_methods(cloud.view(), {find_method("obb"), prism, find_method("cylinder")}, options);
  EXPECT_EQ(numbers(together[1].volume),
            numbers(AnyVolume(*fit_prism(cloud.view(), {Vector3d::UnitZ(), 1}))));
}

}  // namespace
}  // namespace pcl_bv::detail
