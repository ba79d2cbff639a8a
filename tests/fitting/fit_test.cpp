// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/fitting/fit.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cstdint>

#include "clouds.h"
#include "encloses.h"
#include "executions.h"
#include "fits.h"
#include "numbers.h"
#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/fitting/small_ball.h"
#include "pcl_bv/points/point_groups.h"

namespace pcl_bv::detail {
namespace {

using test::bits;
using test::expect_encloses;
using test::numbers;
using test::TestCloud;

template <typename T>
void expect_every_method_encloses() {
  for (const Method& method : methods()) {
    for (const TestCloud<T>& cloud : test::nasty_clouds<T>()) {
      SCOPED_TRACE(std::string(method.name) + ", " + cloud.name);
      AnyVolume volume;
      const EstimationResult result = test::take(method.fit(cloud.view()), volume);
      EXPECT_EQ(result.used + result.dropped, cloud.size());
      EXPECT_EQ(result.status == EstimationStatus::no_valid_points, result.used == 0);
      EXPECT_EQ(empty(volume), result.used == 0);
      expect_encloses(volume, cloud.view());
    }
  }
}

TEST(Fit, EveryMethodEnclosesEveryFloatPointInExactArithmetic) {
  expect_every_method_encloses<float>();
}
TEST(Fit, EveryMethodEnclosesEveryDoublePointInExactArithmetic) {
  expect_every_method_encloses<double>();
}

TEST(Fit, SameBitsForEveryInstructionSetAndThreadCount) {
  std::vector<TestCloud<float>> clouds = test::nasty_clouds<float>();
  clouds.push_back(test::gaussian<float>(std::min<std::size_t>(400'000, test::kThreadedPoints), 78));
  for (const Method& method : methods()) {
    for (const TestCloud<float>& cloud : clouds) {
      AnyVolume expected = *method.fit(cloud.view(), {}, {Serial{}, Isa::scalar});
      for (const auto& [name, execution] : test::every_execution()) {
        SCOPED_TRACE(std::string(method.name) + ", " + cloud.name + ", " + name);
        AnyVolume volume = *method.fit(cloud.view(), {}, execution);
        EXPECT_EQ(bits(volume), bits(expected));
      }
    }
  }
}

template <typename T>
void expect_same_of_groups() {
  PointGroups groups;
  for (const TestCloud<T>& cloud : test::nasty_clouds<T>()) {
    groups.assign(cloud.view());
    for (const Method& method : methods()) {
      AnyVolume expected;
      const EstimationResult said =
          test::take(method.fit(cloud.view(), {}, {Serial{}, Isa::scalar}), expected);
      for (const Isa isa : usable_isas()) {
        SCOPED_TRACE(std::string(method.name) + ", " + cloud.name + ", " + std::string(isa_name(isa)));
        AnyVolume volume;
        const EstimationResult result = test::take(method.fit(groups.view(), {}, {Serial{}, isa}), volume);
        EXPECT_EQ(bits(volume), bits(expected));
        test::expect_same_result(result, said);
      }
    }
  }
}

TEST(Fit, OfFloatGroupsHasTheBitsOfThatOfTheRecordsOnEveryInstructionSet) {
  expect_same_of_groups<float>();
}
TEST(Fit, OfDoubleGroupsHasTheBitsOfThatOfTheRecordsOnEveryInstructionSet) {
  expect_same_of_groups<double>();
}

TEST(Fit, ScalesExactlyByPowersOfTwo) {
  TestCloud<float> cloud = test::gaussian<float>(2000, 13);
  TestCloud<float> scaled = cloud;
  for (float& c : scaled.xyz)
    c *= 0x1p-60F;
  for (const Method& method : methods()) {
    SCOPED_TRACE(method.name);
    AnyVolume a, b;
    a = *method.fit(cloud.view());
    b = *method.fit(scaled.view());
    EXPECT_EQ(numbers(b),
              std::visit([](const auto& shape) { return test::scaled_numbers(shape, 0x1p-60); }, a));
  }
}

TEST(Fit, APointThatIsNoDoubleSumIsEnclosedByTheNextDouble) {
  const TestCloud<double> cloud{"third bit", {1, 0x1p-60, 0, 1, 0x1p-60, 0}};
  Kdop kdop;
  const EstimationResult result = test::take(fit_kdop(cloud.view(), KdopSet::dop26()), kdop);
  EXPECT_EQ(kdop.min(7), 1.0);
  EXPECT_EQ(kdop.max(7), std::nextafter(1.0, 2.0));
  EXPECT_EQ(result.rank, 0) << "the slab has a width, the points have none";
}

TEST(Fit, AKdopOfAnyDirectionsEnclosesInExactArithmetic) {
  const auto set = std::make_shared<const KdopSet>(std::vector<Eigen::Vector3d>{
      {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.3, 0.4, 0.5}, {-0.1, 0.7, 0.2}, {2, -1, 0.001}});
  for (const TestCloud<float>& cloud : test::nasty_clouds<float>()) {
    SCOPED_TRACE(cloud.name);
    Kdop kdop;
    const EstimationResult result = test::take(fit_kdop(cloud.view(), set), kdop);
    EXPECT_EQ(kdop.set(), set);
    EXPECT_EQ(kdop.empty(), result.used == 0);
    expect_encloses(kdop, cloud.view());
  }
}

struct Detection {
  std::uint16_t id;
  float x, y, z;
  double time;
  bool valid;
};

TEST(View, OfAStructMayHaveOtherMembersOfAnyTypes) {
  const std::vector<Detection> points{{7, 1, 2, 3, 0.5, true}, {8, -1, 5, 4, 0.25, false}};
  const Fitted<Aabb> box = fit_aabb(view(points));
  EXPECT_EQ(box->min(), Eigen::Vector3d(-1, 2, 3));
  EXPECT_EQ(box->max(), Eigen::Vector3d(1, 5, 4));
}

TEST(Fit, StatusTellsFlatFromSolidFromNothing) {
  Aabb box;
  EXPECT_EQ(test::take(fit_aabb(test::gaussian<float>(10, 1).view()), box).status, EstimationStatus::ok);
  const float flat[] = {0, 0, 1, 1, 0, 1, 0, 1, 1};
  EXPECT_EQ(test::take(fit_aabb(PointView::of(flat, 12, 3)), box).status, EstimationStatus::degenerate);
  EXPECT_EQ(test::take(fit_aabb(PointView::of(flat, 12, 3)), box).rank, 2);
  EXPECT_EQ(test::take(fit_aabb(PointView()), box).status, EstimationStatus::no_valid_points);
  EXPECT_TRUE(box.empty());
}

TEST(Sphere, Epos26OfOnePointIsThatPoint) {
  const float point[] = {5e6F, -3, 0.1F};
  Sphere sphere = *fit_sphere(PointView::of(point, 12, 1), SphereMethod::epos26);
  EXPECT_EQ(sphere.center(), Eigen::Vector3d(5e6F, -3, static_cast<double>(0.1F)));
  EXPECT_EQ(sphere.radius(), 0.0);
}

TEST(Sphere, Epos26IsTheOptimumWhereTheExtremalPointsDecide) {
  // The 8 corners of a cube among inner points: corners are extremal along the corner directions.
  TestCloud<float> cloud{"cube", {}};
  std::mt19937_64 random(3);
  std::uniform_real_distribution<float> inside(-0.9F, 0.9F);
  for (int i = 0; i < 5000; ++i)
    cloud.xyz.push_back(inside(random));
  cloud.xyz.resize(cloud.xyz.size() / 3 * 3);
  for (int i = 0; i < 8; ++i) {
    for (int axis = 0; axis < 3; ++axis)
      cloud.xyz.push_back((i >> axis & 1) != 0 ? 1.0F : -1.0F);
  }
  Sphere sphere = *fit_sphere(cloud.view(), SphereMethod::epos26);
  EXPECT_NEAR(sphere.radius(), std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(sphere.center().norm(), 0, 1e-12);
}

TEST(Sphere, Epos26IsWithinAHundredthOfTheOptimum) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8}) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const TestCloud<float> cloud = test::gaussian<float>(3000, seed, 4, 100);
    std::vector<Eigen::Vector3d> points;
    const Eigen::Vector3d origin(100, 100, 100);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Coordinates p = load_point(cloud.view(), i);
      points.push_back(Eigen::Vector3d(p.x, p.y, p.z) - origin);
    }
    const double optimum = std::sqrt(smallest_ball(points.data(), points.size()).squared_radius);
    Sphere sphere = *fit_sphere(cloud.view(), SphereMethod::epos26);
    EXPECT_GE(sphere.radius(), optimum * (1 - 1e-12));
    EXPECT_LE(sphere.radius(), optimum * 1.01);
  }
}

}  // namespace
}  // namespace pcl_bv::detail
