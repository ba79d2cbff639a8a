// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Tolerances that grow with the range against their definition, pair by pair.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "pcl_bv/parallel/execution.h"
#include "reference.h"

namespace pcl_bv::detail {
namespace {

using test::Cloud;
using test::ClusterList;
using test::view_of;

template <typename T>
ClusterList by_range(const Cloud<T>& cloud, float tolerance, float per_metre,
                     const ParallelPolicy& policy = Serial{}) {
  ClusterOptions settings{tolerance};
  settings.tolerance_per_metre = per_metre;
  Clusters clusters;
  EuclideanClusterer().extract(view_of(cloud), settings, clusters, policy);
  return test::as_lists(clusters);
}

// The tolerance of a point, by the words of ClusterOptions.
template <typename T>
float tolerance_at(const std::array<T, 3>& p, float tolerance, float per_metre) {
  const double range =
      std::sqrt(double{p[0]} * double{p[0]} + double{p[1]} * double{p[1]} + double{p[2]} * double{p[2]});
  int i = 0;
  while (double{tolerance} * std::pow(2.0, (i + 1) / 4.0) <= double{tolerance} + double{per_metre} * range)
    ++i;
  return static_cast<float>(double{tolerance} * std::pow(2.0, i / 4.0));
}

template <typename T>
ClusterList definition(const Cloud<T>& cloud, float tolerance, float per_metre) {
  std::vector<float> own;
  for (const auto& p : cloud)
    own.push_back(tolerance_at(p, tolerance, per_metre));
  ClusterList lists;
  std::vector<bool> seen(cloud.size());
  for (std::size_t seed = 0; seed < cloud.size(); ++seed) {
    if (seen[seed]) continue;
    std::vector<std::int32_t> queue{static_cast<std::int32_t>(seed)};
    seen[seed] = true;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const auto from = static_cast<std::size_t>(queue[i]);
      for (std::size_t j = 0; j < cloud.size(); ++j) {
        if (seen[j] || !test::linked(cloud[from], cloud[j], std::min(own[from], own[j]))) continue;
        seen[j] = true;
        queue.push_back(static_cast<std::int32_t>(j));
      }
    }
    std::sort(queue.begin(), queue.end());
    lists.push_back(queue);
  }
  std::sort(lists.begin(), lists.end(), [](const auto& a, const auto& b) {
    return a.size() != b.size() ? a.size() > b.size() : a.front() < b.front();
  });
  return lists;
}

// As a sensor in the origin sees: ever sparser the farther out.
template <typename T>
Cloud<T> fan(std::size_t points, unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
  Cloud<T> cloud;
  for (std::size_t i = 0; i < points; ++i) {
    const double range = 1 + 60 * uniform(), angle = 0.9 * uniform();
    cloud.push_back({static_cast<T>(range * std::cos(angle)), static_cast<T>(range * std::sin(angle)),
                     static_cast<T>(uniform())});
  }
  return cloud;
}

template <typename T>
class ClustersByRange : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(ClustersByRange, Scalars);

TYPED_TEST(ClustersByRange, EqualTheirDefinition) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    for (const float per_metre : {0.003F, 0.02F, 0.3F}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", per metre " << per_metre);
      const Cloud<TypeParam> cloud = fan<TypeParam>(700, seed);
      const ClusterList expected = definition(cloud, 0.3F, per_metre);
      EXPECT_EQ(by_range(cloud, 0.3F, per_metre), expected);
      EXPECT_EQ(by_range(cloud, 0.3F, per_metre, Threads{3}), expected);
    }
  }
}

// Each magnitude from 10^-12 to 10^24 has some points, so most levels have.
TYPED_TEST(ClustersByRange, EqualTheirDefinitionAtEveryMagnitude) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> exponent(-12, 24), side(-1, 1);
  Cloud<TypeParam> cloud;
  for (int i = 0; i < 500; ++i) {
    const double scale = std::pow(10, exponent(random));
    cloud.push_back({});
    for (TypeParam& c : cloud.back())
      c = static_cast<TypeParam>(scale * side(random));
  }
  for (const float tolerance : {1e-6F, 0.5F, 1e6F}) {
    for (const float per_metre : {1e-9F, 0.02F, 0.7F, 5.F, 1e6F}) {
      SCOPED_TRACE(testing::Message() << tolerance << ", per metre " << per_metre);
      EXPECT_EQ(by_range(cloud, tolerance, per_metre), definition(cloud, tolerance, per_metre));
    }
  }
}

TYPED_TEST(ClustersByRange, OfNoGrowthAreThoseOfTheToleranceAlone) {
  const Cloud<TypeParam> cloud = fan<TypeParam>(900, 11);
  EXPECT_EQ(by_range(cloud, 1.5F, 0.0F), test::brute_force(cloud, 1.5F));
  EXPECT_EQ(by_range(cloud, 1.5F, 1e-9F), test::brute_force(cloud, 1.5F));  // no step within 60 m
}

// At 100 m the tolerance is 0.5 + 1 m and so 2^(6/4) * 0.5; at 20 m it is 0.5 + 0.2 and so 2^(1/4) * 0.5.
TYPED_TEST(ClustersByRange, OfTwoPointsTheSmallerToleranceCountsInStepsOfAQuarterOctave) {
  const auto pair = [](double x, double apart) {
    return Cloud<TypeParam>{{static_cast<TypeParam>(x), 0, 0}, {static_cast<TypeParam>(x + apart), 0, 0}};
  };
  EXPECT_EQ(by_range(pair(100, 1.41), 0.5F, 0.01F).size(), 1U);
  EXPECT_EQ(by_range(pair(100, 1.42), 0.5F, 0.01F).size(), 2U);
  EXPECT_EQ(by_range(pair(20, 0.59), 0.5F, 0.01F).size(), 1U);
  EXPECT_EQ(by_range(pair(20, 0.6), 0.5F, 0.01F).size(), 2U);
  EXPECT_EQ(by_range(pair(19.9, 24), 0.5F, 1.0F).size(), 2U);  // 2^(21/4) * 0.5 = 19.03 at the nearer one
  EXPECT_EQ(by_range(pair(19.9, 19), 0.5F, 1.0F).size(), 1U);
}

TYPED_TEST(ClustersByRange, SkipPointsThatAreNotFinite) {
  Cloud<TypeParam> cloud = fan<TypeParam>(300, 5);
  const std::size_t before = by_range(cloud, 0.5F, 0.05F).size();
  cloud.push_back({std::numeric_limits<TypeParam>::infinity(), 0, 0});
  cloud.push_back({0, std::numeric_limits<TypeParam>::quiet_NaN(), 0});
  EXPECT_EQ(by_range(cloud, 0.5F, 0.05F).size(), before);
}

TEST(ClustersByRange, AGrowthThatIsNoneOrGoesWithDbscanIsRefused) {
  const auto message = [](float per_metre, std::size_t min_points) -> std::string {
    ClusterOptions settings{0.5F};
    settings.tolerance_per_metre = per_metre;
    settings.min_points = min_points;
    Clusters clusters;
    try {
      EuclideanClusterer().extract(PointView(), settings, clusters);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message(-1, 1), "cluster tolerance_per_metre is -1, must be finite and at least 0");
  EXPECT_EQ(message(std::numeric_limits<float>::infinity(), 1),
            "cluster tolerance_per_metre is inf, must be finite and at least 0");
  EXPECT_EQ(message(0.01F, 5), "cluster min_points is 5, must be 1 if tolerance_per_metre is above 0");
  EXPECT_EQ(message(0, 5), "");
}

TEST(ClustersByRange, AnOriginThatIsNoPositionIsRefused) {
  const Cloud<float> cloud{{0, 0, 0}, {1, 0, 0}};
  for (const double bad : {double{NAN}, double{INFINITY}, 1.1e100}) {
    ClusterOptions settings{0.5F};
    settings.tolerance_per_metre = 0.01F;
    settings.range_origin.y() = bad;
    Clusters clusters;
    EXPECT_THROW(EuclideanClusterer().extract(view_of(cloud), settings, clusters), std::invalid_argument)
        << bad;
  }
}

}  // namespace
}  // namespace pcl_bv::detail
