// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Queries for the farthest points of a cloud, and the smallest sphere from their answers.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "fits.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/fitting/smallest_sphere.h"
#include "pcl_bv/numeric/float_environment.h"
#include "sources.h"
#include "sphere_clouds.h"

namespace pcl_bv::detail {
namespace {

using test::expect_equal;
using test::points_of;
using test::TestCloud;

// The definition of FarthestQuery, for a part of a cloud.
OctantPoints farthest_by_definition(const PointView& part, const FarQuery& query) {
  const auto& [center, limit, one_of] = query;
  OctantPoints found;
  for (std::size_t i = 0; i < part.count; ++i) {
    const Coordinates p = load_point(part, i);
    if (!in_sample(part.index(i) / kBlockPoints, one_of)) continue;
    if (!is_valid(p) || !(squared_distance(p, center) >= limit)) continue;
    FarPoint& best = found[octant(p, center)];
    const FarPoint candidate{squared_distance(p, center), part.index(i), p};
    if (candidate.squared_distance > best.squared_distance) best = candidate;
  }
  return found;
}

template <typename T>
void expect_same_from_two_halves(const TestCloud<T>& cloud) {
  SCOPED_TRACE(cloud.name);
  const PointView points = cloud.view();
  const Supports supports = find_supports(points, DirectionSet::dop26, SupportDetail::points, {});
  int queries = 0;
  const auto answer = [&](const FarQuery& query, OctantPoints& found) {
    ++queries;
    const std::size_t half = points.count / 2;
    found = farthest_by_definition(points.slice(half, points.count - half), query);
    update_farthest(farthest_by_definition(points.slice(0, half), query), found);
    return std::any_of(found.begin(), found.end(), [](const FarPoint& p) { return p.squared_distance >= 0; });
  };
  Sphere expected;
  SphereCertificate certificate, of_fit;
  test::take(fit_smallest_sphere(points), expected, of_fit);
  EXPECT_EQ(smallest_sphere(supports, answer, certificate), expected);
  EXPECT_EQ(certificate.support, of_fit.support);
  EXPECT_EQ(certificate.passes, queries);
}

TEST(SmallestSphere, HasTheSameBitsWhoeverAnswersForThePoints) {
  const FloatEnvironment environment;
  for (const TestCloud<float>& cloud : test::nasty_clouds<float>())
    expect_same_from_two_halves(cloud);
  for (const TestCloud<double>& cloud : test::nasty_clouds<double>())
    expect_same_from_two_halves(cloud);
  for (const char* shape : {"ball", "surface", "hemisphere", "corners"}) {
    for (const std::size_t n : {5000, 40000})  // without and with a sample
      expect_same_from_two_halves(points_of(shape, n));
  }
}

TEST(SmallestSphere, StartsWithASampleOfLargeClouds) {
  EXPECT_EQ(blocks_per_sampled(32 * kBlockPoints - 1), 1U);
  EXPECT_EQ(blocks_per_sampled(32 * kBlockPoints), 16U);
  EXPECT_EQ(blocks_per_sampled(1'000'000), 64U);
  for (const std::size_t one_of : {1, 16, 64, 1024}) {
    SCOPED_TRACE(one_of);
    // In any 16 rows of blocks, whatever their length.
    for (const std::size_t period : {1, 2, 16, 64, 100}) {
      std::size_t sampled = 0;
      for (std::size_t row = 0; row < 16 * one_of; ++row)
        sampled += in_sample(row * period, one_of);
      EXPECT_NEAR(static_cast<double>(sampled), 16, 8) << "period " << period;
    }
    for (std::size_t block = 0; block < 10'000; ++block)
      EXPECT_TRUE(!in_sample(block, 2 * one_of) || in_sample(block, one_of));
  }
}

// Queries with a centre that moves little, and sometimes much.
template <typename T>
void expect_answers_by_definition(const PointView& points, const TestCloud<T>& cloud, double scale) {
  SCOPED_TRACE(cloud.name + ", " + std::to_string(points.count) + " points");
  FarthestFinder find(points);
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int trial = 0; trial < 100; ++trial) {
    SCOPED_TRACE(trial);
    const double step = trial % 10 == 9 ? 1e-2 : 2e-8;
    const double radius = scale * (1 + step * uniform(random) + 3e-8);
    const FarQuery query{{step * uniform(random), step * uniform(random), step * uniform(random), scale},
                         radius * radius,
                         trial % 10 == 0 ? 16U : 1U};
    OctantPoints found;
    find(query, found);
    const OctantPoints expected =
        farthest_by_definition(cloud.view().slice(points.first, points.count), query);
    for (std::size_t o = 0; o < 8; ++o) {
      EXPECT_EQ(found[o].squared_distance, expected[o].squared_distance);
      EXPECT_EQ(found[o].index, expected[o].index);
    }
  }
}

TEST(FarthestFinder, AnswersAnySequenceOfQueries) {
  const FloatEnvironment environment;
  const TestCloud<float> cloud = points_of("surface", 40'000);
  const TestCloud<double> doubles{"doubles", {cloud.xyz.begin(), cloud.xyz.end()}};
  const test::CopyingSource<float> source(cloud);
  expect_answers_by_definition(cloud.view(), cloud, 1);
  expect_answers_by_definition(doubles.view(), doubles, 0.5);
  expect_answers_by_definition(source.view(), cloud, 1);
  // Parts: without points, with one, and with blocks that begin inside the part.
  for (const std::size_t count : {0, 1, 20'000})
    expect_answers_by_definition(cloud.view().slice(1000, count), cloud, 1);
}

TEST(SmallestSphere, HasTheSameBitsForPointsOfASource) {
  for (const char* shape : {"gauss", "surface", "corners"}) {
    SCOPED_TRACE(shape);
    TestCloud<float> cloud = points_of(shape, 150'000);
    for (const std::size_t i : {0, 1024, 70'000})
      cloud.xyz[3 * i] = std::numeric_limits<float>::quiet_NaN();
    cloud.xyz[3 * 99'999 + 1] = std::numeric_limits<float>::infinity();
    const test::CopyingSource<float> source(cloud);
    const auto expected = pcl_bv::fit_smallest_sphere(cloud.view());
    const auto sphere = pcl_bv::fit_smallest_sphere(source.view());
    expect_equal(*sphere, *expected);
    EXPECT_EQ(sphere.dropped, 4U);
    EXPECT_EQ(sphere.certificate.passes, expected.certificate.passes);
    // The pass for the supports, the one for the sample, and one or two over all points.
    EXPECT_LE(source.loads, 3 * chunk_count(cloud.size()) + 10);
  }
}

}  // namespace
}  // namespace pcl_bv::detail
